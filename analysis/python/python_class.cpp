#include "python_class.hpp"

#include <algorithm>
#include <atomic>
#include <map>
#include <set>

#include "shoal/core/options_impl.hpp"
#include "shoal/core/text.hpp"

namespace shoal::python {
namespace {

std::atomic<int> under_way = 0;
std::atomic<bool> own_code = false;

/// Names by family of the members that are classes of Python.
std::map<std::string, std::set<std::string>>& names_of_classes() {
  static std::map<std::string, std::set<std::string>> names;
  return names;
}

/// A parameter of the constructor, of the type that its default has.
Option parameter(const std::string& name, const Setting& fallback, const std::string& unit,
                 const std::string& meaning) {
  Option option{.name = name, .unit = unit, .meaning = meaning};
  struct TypeOf {
    const char* operator()(bool) const { return "true or false"; }
    const char* operator()(std::int64_t) const { return "an integer"; }
    const char* operator()(double) const { return "a number"; }
    const char* operator()(const std::string&) const { return "a string"; }
    const char* operator()(const Setting::List&) const { return nullptr; }
    const char* operator()(const Setting::Table&) const { return nullptr; }
  };
  const char* type = std::visit(TypeOf{}, fallback.value);
  if (!type) {
    throw InputError("the parameter " + name + " has " + std::string(fallback.type_name()) +
                     " as default; options are numbers, texts, True or False");
  }
  option.type = type;
  const Option described = option;
  option.read = [described, fallback](void* object, const Setting& value, const std::string& key) {
    Setting& mine = static_cast<PythonOptions*>(object)->values.at_or_new(described.name);
    if (std::holds_alternative<double>(fallback.value)) {
      mine.value = detail::as_number(described, value, key);
    } else if (std::holds_alternative<std::int64_t>(fallback.value)) {
      mine.value = detail::as_integer(described, value, key);
    } else if (value.value.index() == fallback.value.index()) {
      mine.value = value.value;
    } else {
      detail::refuse_type(described, value, key);
    }
  };
  option.write = [name](const void* object) {
    return *static_cast<const PythonOptions*>(object)->values.find(name);
  };
  return option;
}

}  // namespace

bool Held::flag(const char* name) const {
  if (!has(name)) return false;
  const py::object value = attr(name);
  if (!py::isinstance<py::bool_>(value)) {
    throw InputError(std::string(name) + " of the class is " +
                     std::string(py::str(py::repr(value))) + "; it takes True or False");
  }
  return value.cast<bool>();
}

PythonClass::PythonClass(std::string name, std::string version, const py::object& type,
                         const py::list& parameters, bool solves)
    : name_(std::move(name)), version_(std::move(version)), type_(type) {
  defaults_.version = version_;
  Options<PythonOptions> common;
  common.text("version", &PythonOptions::version,
              "of the class, so that a scenario is not run with another text of it");
  if (solves) solvers::declare_limits(common);
  std::vector<Option> all = common.take();
  for (const py::handle each : parameters) {
    const auto [parameter_name, fallback, unit, meaning] =
        each.cast<std::tuple<std::string, py::object, std::string, std::string>>();
    if (std::ranges::find(all, parameter_name, &Option::name) != all.end()) {
      throw InputError("the parameter " + parameter_name + " of " + name_ +
                       " has the name of an option that all have; rename it");
    }
    const Setting value = to_setting(fallback);
    all.push_back(parameter(parameter_name, value, unit, meaning));
    defaults_.values.at_or_new(parameter_name) = value;
  }
  if (!defaults_.values.is_table()) defaults_.values.value = Setting::Table{};
  schema_.options = std::move(all);
  schema_.defaults = write_options(schema_, &defaults_);
}

PythonOptions PythonClass::read(const Setting& table, const std::string& path) const {
  PythonOptions options = defaults_;
  read_options(schema_, &options, table, path);
  if (options.version != version_) {
    throw InputError(table.origin, path + ": this was written with version " + options.version +
                                       " of the class " + name_ + ", which is " + version_ +
                                       " here; leave the version out to run it with this one");
  }
  return options;
}

std::shared_ptr<const Held> PythonClass::make(const PythonOptions& options) const {
  const py::gil_scoped_acquire held;
  const py::dict given = to_python(options.values).cast<py::dict>();
  return std::make_shared<const Held>(type_.object()(**given));
}

bool can_be_written(const std::string& name) {
  const auto fits = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
  };
  return !name.empty() && std::ranges::all_of(name, fits);
}

bool is_class(const std::string& family, const std::string& name) {
  return names_of_classes()[family].contains(name);
}

bool has_own_code() {
  return own_code;
}

void note_own_code() {
  own_code = true;
}

NoNewMembers::NoNewMembers() {
  ++under_way;
}

NoNewMembers::~NoNewMembers() {
  --under_way;
}

void require_free(const RegistryBase& registry, const std::string& name) {
  if (under_way > 0) {
    throw InputError("a run or a sweep is under way; make " + name + " known before it");
  }
  if (!can_be_written(name)) {
    throw InputError("the kind \"" + name +
                     "\" cannot be written in a scenario; use a to z, 0 to 9 and _");
  }
  std::set<std::string>& classes = names_of_classes()[registry.family()];
  if (!classes.contains(name) && (registry.find(name) || registry.has_below(name))) {
    throw InputError("there is a " + registry.family() + " \"" + name +
                     "\" already; give the class another kind");
  }
  classes.insert(name);
  note_own_code();
}

}  // namespace shoal::python
