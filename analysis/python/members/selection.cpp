#include <algorithm>

#include "../python_class.hpp"
#include "shoal/formations/selection.hpp"

namespace shoal::python {
namespace {

using formations::Neighbour;
using formations::Selection;

/// A class with a method select(positions), which returns indices.
class PythonSelection final : public Selection {
 public:
  PythonSelection(std::shared_ptr<const Held> object, std::string name)
      : object_(std::move(object)), name_(std::move(name)) {
    const py::gil_scoped_acquire held;
    if (!object_->has("select")) {
      throw InputError("the class " + name_ + " has no method select(positions)");
    }
  }

  void select(std::span<const Neighbour> in_range, std::vector<int>& chosen) const override {
    chosen.clear();
    if (in_range.empty()) return;
    const py::gil_scoped_acquire held;
    const auto n = static_cast<py::ssize_t>(in_range.size());
    Array positions({n, py::ssize_t{2}});
    for (py::ssize_t i = 0; i < n; ++i) {
      positions.mutable_at(i, 0) = in_range[static_cast<std::size_t>(i)].position.x();
      positions.mutable_at(i, 1) = in_range[static_cast<std::size_t>(i)].position.y();
    }
    const Array answer = real_array(object_->attr("select")(positions), name_ + ".select()");
    for (py::ssize_t k = 0; k < answer.size(); ++k) {
      const double index = answer.data()[k];
      if (!(index >= 0.0 && index < static_cast<double>(n)) || index != static_cast<int>(index)) {
        refuse("indices from 0 to the number of neighbours, less one");
      }
      if (std::ranges::find(chosen, static_cast<int>(index)) != chosen.end()) {
        refuse("no index twice");
      }
      chosen.push_back(static_cast<int>(index));
    }
    if (chosen.empty()) refuse("at least one index, where there are neighbours");
  }

 private:
  [[noreturn]] void refuse(const char* wanted) const {
    throw InputError(name_ + ".select() has to return " + wanted);
  }

  std::shared_ptr<const Held> object_;
  std::string name_;
};

}  // namespace

void put_selection(const std::shared_ptr<const PythonClass>& type, const std::string& summary) {
  put_class<Selection>(type, summary, [](const PythonClass& from, const PythonOptions& options) {
    return std::make_unique<PythonSelection>(from.make(options), from.name());
  });
}

}  // namespace shoal::python
