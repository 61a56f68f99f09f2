#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <mutex>
#include <optional>
#include <span>

#include "conversions.hpp"
#include "potentials.hpp"
#include "python_class.hpp"
#include "shoal/core/options_impl.hpp"
#include "shoal/core/text.hpp"
#include "shoal/formations/potential.hpp"

namespace shoal::python {
namespace {

using formations::Potential;
using formations::RadialValue;

/// Python functions, (r, s) -> (value, slope, curvature), by name and hash. Never destroyed:
/// the interpreter may be gone before.
class Functions {
 public:
  static Functions& instance() {
    static auto* const all = new Functions;
    return *all;
  }

  void keep(const std::string& key, py::object function) {
    const std::lock_guard lock(mutex_);
    functions_.insert_or_assign(key, std::move(function));
  }

  /// nullptr if there is none.
  const py::object* find(const std::string& key) const {
    const std::lock_guard lock(mutex_);
    const auto found = functions_.find(key);
    return found == functions_.end() ? nullptr : &found->second;
  }

 private:
  mutable std::mutex mutex_;
  std::map<std::string, py::object> functions_;
};

/// Which function, and a hash of what it does: part of a scenario, so that another function of the
/// same name is another scenario.
struct PythonFunction {
  std::string name;
  std::string source;
  bool batch = false;
  double from_m = 0.1;
  double to_m = 10'000.0;

  static void declare(Options<PythonFunction>& o) {
    using F = PythonFunction;
    o.text("name", &F::name, "of a function given to shoal.potential()");
    o.text("source", &F::source, "hash of the function, written by shoal.potential()");
    o.flag("batch", &F::batch, "the function takes arrays, and a table is made of it beforehand");
    o.number("from_m", &F::from_m, "m", above(0), "smallest distance of that table");
    o.number("to_m", &F::to_m, "m", above(0), "its largest distance");
  }

  std::string key() const { return name + " " + source; }

  std::optional<std::string> complaint() const {
    if (!(from_m < to_m)) return "from_m must be below to_m";
    if (Functions::instance().find(key())) return std::nullopt;
    return "the function \"" + name +
           "\" is not known here: give it to shoal.potential() in the program that runs it";
  }
};

/// Value, slope and curvature, as they were returned.
std::array<py::object, 3> answers_of(const py::object& function, const py::object& r, double s) {
  return function(r, s).cast<std::array<py::object, 3>>();
}

constexpr std::array parts{"the potential", "its slope", "its curvature"};

std::vector<RadialValue> asked(const py::object& function, std::span<const double> r, double s) {
  const Array distances(static_cast<py::ssize_t>(r.size()), r.data());
  const std::array<py::object, 3> given = answers_of(function, distances, s);
  const Array value = real_array(given[0], parts[0]), slope = real_array(given[1], parts[1]),
              curvature = real_array(given[2], parts[2]);
  for (const Array* each : {&value, &slope, &curvature}) {
    if (each->size() != distances.size()) {
      throw InputError("the function gave " + std::to_string(each->size()) + " numbers for " +
                       std::to_string(distances.size()) + " distances; it is meant to take arrays");
    }
  }
  std::vector<RadialValue> answers;
  for (py::ssize_t i = 0; i < distances.size(); ++i) {
    answers.push_back({value.data()[i], slope.data()[i], curvature.data()[i]});
  }
  return answers;
}

/// A function of the distance at nodes that are evenly spread in log r, and quintic polynomials of
/// log r that take its value and derivatives at both their nodes.
class RadialTable {
 public:
  RadialTable(const py::object& function, double from_m, double to_m, double s)
      : first_(std::log(from_m)), step_((std::log(to_m) - first_) / (nodes - 1)) {
    std::vector<double> r, between;
    for (int k = 0; k < nodes; ++k) r.push_back(std::exp(first_ + k * step_));
    for (int k = 0; k + 1 < nodes; ++k) between.push_back(std::exp(first_ + (k + 0.5) * step_));
    for (const RadialValue& f : asked(function, r, s)) {
      const double at = r[values_.size()];
      // By u = log r: f_u = r f', f_uu = r f' + r^2 f''.
      values_.push_back({f.value, at * f.slope, at * f.slope + at * at * f.curvature});
    }
    const std::vector<RadialValue> exact = asked(function, between, s);
    for (std::size_t k = 0; k < exact.size(); ++k) {
      const RadialValue here = *at(between[k]);
      const double scale = std::abs(exact[k].value) + between[k] * std::abs(exact[k].slope);
      const double off = std::abs(here.value - exact[k].value) +
                         between[k] * std::abs(here.slope - exact[k].slope);
      if (!(off <= 1e-9 * scale + 1e-300)) {
        throw InputError(
            "the function is too rough, or not finite, at r = " + std::to_string(between[k]) +
            " m for a table; change from_m and to_m, or do without batch");
      }
    }
  }

  /// Nothing outside the table.
  std::optional<RadialValue> at(double r) const {
    const double place = (std::log(r) - first_) / step_;
    if (!(place >= 0.0 && place <= nodes - 1)) return std::nullopt;
    const auto k = std::min(static_cast<std::size_t>(place), values_.size() - 2);
    const double t = place - static_cast<double>(k), h = step_;
    const RadialValue &a = values_[k], &b = values_[k + 1];
    // Taylor to second order from the left, and what is left of the right in powers 3 to 5.
    const double c1 = h * a.slope, c2 = 0.5 * h * h * a.curvature;
    const double d0 = b.value - a.value - c1 - c2, d1 = h * b.slope - c1 - 2.0 * c2,
                 d2 = h * h * b.curvature - 2.0 * c2;
    const double c3 = 10.0 * d0 - 4.0 * d1 + 0.5 * d2, c4 = -15.0 * d0 + 7.0 * d1 - d2,
                 c5 = 6.0 * d0 - 3.0 * d1 + 0.5 * d2;
    const double value = a.value + t * (c1 + t * (c2 + t * (c3 + t * (c4 + t * c5))));
    const double by_u = (c1 + t * (2.0 * c2 + t * (3.0 * c3 + t * (4.0 * c4 + t * 5.0 * c5)))) / h;
    const double by_uu = (2.0 * c2 + t * (6.0 * c3 + t * (12.0 * c4 + t * 20.0 * c5))) / (h * h);
    return RadialValue{value, by_u / r, (by_uu - by_u) / (r * r)};
  }

 private:
  static constexpr int nodes = 4096;
  double first_, step_;
  std::vector<RadialValue> values_;  // with derivatives by log r
};

class PythonPotential final : public Potential {
 public:
  explicit PythonPotential(const PythonFunction& function)
      : options_(function), function_(Functions::instance().find(function.key())) {}

  void prepare(double separation_m) override {
    if (!options_.batch) {
      derivatives(separation_m, separation_m);  // what no run could use is refused before it
      return;
    }
    const py::gil_scoped_acquire held;
    table_.emplace(*function_, options_.from_m, options_.to_m, separation_m);
    prepared_m_ = separation_m;
  }

  double value(double r, double s) const override { return derivatives(r, s).value; }

  RadialValue derivatives(double r, double s) const override {
    if (table_ && s == prepared_m_) {
      if (const std::optional<RadialValue> found = table_->at(r)) return *found;
    }
    const py::gil_scoped_acquire held;
    if (options_.batch) return asked(*function_, std::span(&r, 1), s).front();
    const std::array<py::object, 3> given = answers_of(*function_, py::float_(r), s);
    std::array<double, 3> numbers{};
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      numbers[i] = real_number(given[i], parts[i]);
      if (std::isfinite(numbers[i]) || r == 0.0) continue;
      throw InputError(std::string(parts[i]) + " is " + shortest(numbers[i]) + " at r = " +
                       shortest(r) + " m and s = " + shortest(s) + " m; it has to be finite");
    }
    return {numbers[0], numbers[1], numbers[2]};
  }

 private:
  PythonFunction options_;
  const py::object* function_;  // stays where it is
  std::optional<RadialTable> table_;
  double prepared_m_ = 0.0;
};

const Register<Potential, PythonFunction> registered{
    "python", "a Python function",
    [](const PythonFunction& function) { return std::make_unique<PythonPotential>(function); }};

/// A potential by kind and options, ready for one separation after the other.
class NamedPotential {
 public:
  NamedPotential(const std::string& kind, const py::dict& options)
      : kind_(kind), options_(to_setting(options)) {
    make();
  }

  /// Arrays of the shape of r: value, slope (1/m), curvature (1/m2).
  py::tuple derivatives(const py::object& distances, const py::object& separation) const {
    const Array r = array_argument(distances, "r");
    const double s = number_argument(separation, "s");
    std::unique_ptr<Potential> potential = make();
    if (const auto why = potential->complaint(s)) throw InputError(kind_ + ": " + *why);
    potential->prepare(s);
    const std::vector<py::ssize_t> shape(r.shape(), r.shape() + r.ndim());
    Array value(shape), slope(shape), curvature(shape);
    for (py::ssize_t i = 0; i < r.size(); ++i) {
      const RadialValue f = potential->derivatives(r.data()[i], s);
      value.mutable_data()[i] = f.value;
      slope.mutable_data()[i] = f.slope;
      curvature.mutable_data()[i] = f.curvature;
    }
    return py::make_tuple(value, slope, curvature);
  }

  py::dict setting() const {
    py::dict table;
    table["kind"] = kind_;
    table[py::str(kind_)] = to_python(options_);
    return table;
  }

 private:
  std::unique_ptr<Potential> make() const {
    return Registry<Potential>::instance().make(kind_, options_, "potential." + kind_);
  }

  std::string kind_;
  Setting options_;
};

}  // namespace

bool has_scalar_function(const Setting& setting) {
  if (!setting.is_table()) return false;
  const Setting* kind = setting.find("kind");
  const auto* name = kind ? std::get_if<std::string>(&kind->value) : nullptr;
  if (name && *name == "python") {
    const Setting* batch = setting.find_path("python.batch");
    return !batch || !std::get<bool>(batch->value);
  }
  return std::ranges::any_of(setting.table(), [&](const auto& entry) {
    const bool chosen = !name || !entry.second.is_table() || entry.first == *name;
    return chosen && has_scalar_function(entry.second);
  });
}

void add_potentials(py::module_& module) {
  module.def(
      "keep_function",
      [](const std::string& name, const std::string& source, const py::object& function) {
        note_own_code();
        Functions::instance().keep(PythonFunction{name, source}.key(), function);
      },
      py::arg("name"), py::arg("source"), py::arg("function"));
  py::class_<NamedPotential>(module, "NamedPotential")
      .def(py::init<const std::string&, const py::dict&>(), py::arg("kind"), py::arg("options"))
      .def("derivatives", &NamedPotential::derivatives, py::arg("r"), py::arg("s"))
      .def("_setting_", &NamedPotential::setting);
}

}  // namespace shoal::python
