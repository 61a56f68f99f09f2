#include <algorithm>
#include <cmath>

#include "../python_class.hpp"
#include "../world_view.hpp"
#include "shoal/analysis/experiments/build_info.hpp"
#include "shoal/analysis/experiments/measure.hpp"

namespace shoal::python {
namespace {

using analysis::Quantity;
using scenarios::World;

/// What a class says that it yields: a dict, name -> (unit, meaning).
std::vector<Quantity> declared(const PythonClass& type, const char* attribute) {
  std::vector<Quantity> all;
  const py::object given = py::getattr(type.type(), attribute, py::dict());
  const std::string where = std::string(attribute) + " of " + type.name();
  if (!py::isinstance<py::dict>(given)) throw InputError(where + " has to be a dict");
  for (const auto& [name, about] : given.cast<py::dict>()) {
    Quantity quantity{.name = text_argument(name, "a name in " + where)};
    if (!py::isinstance<py::tuple>(about) || py::len(about) != 2) {
      throw InputError(where + ": " + quantity.name + " takes a tuple (unit, meaning)");
    }
    const auto pair = about.cast<py::tuple>();
    quantity.unit = text_argument(pair[0], "the unit of " + quantity.name);
    quantity.meaning = text_argument(pair[1], "the meaning of " + quantity.name);
    if (!can_be_written(quantity.name)) {
      throw InputError(where + ": the name \"" + quantity.name +
                       "\" cannot be written in a study; use a to z, 0 to 9 and _");
    }
    all.push_back(quantity);
  }
  return all;
}

/// Throws InputError for names that another measure has.
void require_new(const std::vector<Quantity>& quantities, const std::string& kind,
                 std::vector<Quantity> (analysis::Measure::*list)() const) {
  const auto& registry = Registry<analysis::Measure>::instance();
  for (const MemberInfo& member : registry.members()) {
    if (member.name == kind) continue;
    const auto measure = registry.make(member.name, Setting{}, member.name);
    for (const Quantity& known : ((*measure).*list)()) {
      for (const Quantity& quantity : quantities) {
        if (quantity.name != known.name) continue;
        throw InputError("the measure " + member.name + " yields \"" + known.name +
                         "\" already; give it another name in " + kind);
      }
    }
  }
}

/// A class with a method finish(world), and begin(world) and observe(world) if it wants them.
class PythonMeasure final : public analysis::Measure {
 public:
  PythonMeasure(const PythonClass& type, PythonOptions options, std::vector<Quantity> values,
                std::vector<Quantity> series)
      : type_(type),
        options_(std::move(options)),
        values_(std::move(values)),
        series_(std::move(series)) {}

  std::vector<Quantity> values() const override { return values_; }
  std::vector<Quantity> series() const override { return series_; }

  /// Made here and not before: measures are also made to ask what they yield, from any thread.
  void begin(const World& world) override {
    const py::gil_scoped_acquire held;
    object_ = type_.make(options_);
    every_s_ = log_interval_s(world);
    if (object_->has("every_s")) {
      every_s_ = number_argument(object_->attr("every_s"), "every_s of " + type_.name());
      if (!(every_s_ >= 0.0 && std::isfinite(every_s_))) {
        throw InputError("every_s of " + type_.name() + " takes a finite number of at least 0");
      }
    }
    if (!object_->has("observe")) every_s_ = 0.0;
    if (object_->has("begin")) WorldView::show(world, object_->attr("begin"));
  }

  void observe(const World& world) override {
    const py::gil_scoped_acquire held;
    WorldView::show(world, object_->attr("observe"));
  }

  void finish(const World& world, analysis::Results& results) const override {
    const py::gil_scoped_acquire held;
    const py::object answer = WorldView::show(world, object_->attr("finish"));
    if (!py::isinstance<py::dict>(answer)) refuse("a dict of what it yields");
    const auto given = answer.cast<py::dict>();
    for (const auto& [name, value] : given) {
      const std::string text = text_argument(name, "a name of " + type_.name() + ".finish()");
      if (!yields(text)) refuse("only what the class declares, and not \"" + text + "\"");
    }
    for (const Quantity& each : values_) results.add(each.name, number(given, each.name));
    for (const Quantity& each : series_) add_series(given, each.name, results);
  }

 private:
  bool yields(const std::string& name) const {
    const auto same = [&](const Quantity& each) { return each.name == name; };
    return std::ranges::any_of(values_, same) || std::ranges::any_of(series_, same);
  }

  std::optional<double> number(const py::dict& given, const std::string& name) const {
    const py::str key(name);
    if (!given.contains(key) || given[key].is_none()) return std::nullopt;
    const double x = real_number(given[key], name + " of " + type_.name() + ".finish()");
    if (!std::isfinite(x)) refuse("a finite number as " + name + ", or None where it has none");
    return x;
  }

  void add_series(const py::dict& given, const std::string& name,
                  analysis::Results& results) const {
    const py::str key(name);
    if (!given.contains(key)) {
      results.add_series(name, {}, {});
      return;
    }
    const py::object pair = given[key];
    if (!py::isinstance<py::sequence>(pair) || py::len(pair) != 2) {
      refuse("(times, numbers) as " + name);
    }
    const auto row = [&](int k) {
      const Array array = real_array(pair[py::int_(k)], name + " of " + type_.name() + ".finish()");
      return std::vector<double>(array.data(), array.data() + array.size());
    };
    std::vector<double> times = row(0), numbers = row(1);
    const auto finite = [](double x) { return std::isfinite(x); };
    if (times.size() != numbers.size() || !std::ranges::all_of(times, finite) ||
        !std::ranges::all_of(numbers, finite)) {
      refuse("as many finite times as finite numbers as " + name);
    }
    results.add_series(name, std::move(times), std::move(numbers));
  }

  [[noreturn]] void refuse(const std::string& wanted) const {
    throw InputError(type_.name() + ".finish() has to return " + wanted);
  }

  const PythonClass& type_;  // lives as long as its entry in the registry
  PythonOptions options_;
  std::vector<Quantity> values_, series_;
  std::shared_ptr<const Held> object_;
};

}  // namespace

void put_measure(const std::shared_ptr<const PythonClass>& type, const std::string& summary) {
  if (!py::hasattr(type->type(), "finish")) {
    throw InputError("the class " + type->name() + " has no method finish(world)");
  }
  const std::vector<Quantity> values = declared(*type, "values"),
                              series = declared(*type, "series");
  if (values.empty() && series.empty()) {
    throw InputError("the class " + type->name() +
                     " yields nothing; give it values = {name: (unit, meaning)}");
  }
  require_new(values, type->name(), &analysis::Measure::values);
  require_new(series, type->name(), &analysis::Measure::series);
  put_class<analysis::Measure>(
      type, summary, [values, series](const PythonClass& from, const PythonOptions& options) {
        return std::make_unique<PythonMeasure>(from, options, values, series);
      });
  // Every trial has it: trials that were stored without it, or with another, are others.
  analysis::make_part_of_program("measure " + type->name(), type->name() + "-" + type->version());
}

}  // namespace shoal::python
