#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "conversions.hpp"
#include "shoal/core/registry.hpp"
#include "shoal/solvers/smooth/limits.hpp"

namespace shoal::python {

/// An object of Python that any thread may let go.
class [[gnu::visibility("hidden")]] Held {  // as all of pybind11 is
 public:
  explicit Held(py::object object) : object_(std::move(object)) {}
  Held(const Held&) = delete;
  Held& operator=(const Held&) = delete;
  ~Held() {
    if (Py_IsInitialized() == 0) {  // at the end of the process, when the registries go
      object_.release();
      return;
    }
    const py::gil_scoped_acquire held;
    object_ = {};
  }

  const py::object& object() const {
    return object_;
  }
  py::object attr(const char* name) const {
    return object_.attr(name);
  }
  bool has(const char* name) const {
    return py::hasattr(object_, name);
  }
  bool flag(const char* name) const;  ///< False where it has none. Throws InputError.

 private:
  py::object object_;
};

/// The options of an object: what its constructor takes, and what any member of its family has.
struct PythonOptions {
  Setting values;
  std::string version;
  std::int64_t max_evaluations = solvers::Limits{}.max_evaluations;  // of solvers
  double x_tolerance_m = solvers::Limits{}.x_tolerance_m;
};

/// A class of Python that is a member of a family.
class [[gnu::visibility("hidden")]] PythonClass {
 public:
  /// `parameters`: of the constructor, each (name, default, unit, meaning).
  PythonClass(std::string name, std::string version, const py::object& type,
              const py::list& parameters, bool solves);

  const std::string& name() const {
    return name_;
  }
  const std::string& version() const {
    return version_;
  }
  const Schema& schema() const {
    return schema_;
  }
  py::object type() const {
    return type_.object();
  }

  /// Throws InputError for what is no option, and for another version of the class.
  PythonOptions read(const Setting& table, const std::string& path) const;

  /// A new object. Throws what its constructor raises. Takes the interpreter.
  std::shared_ptr<const Held> make(const PythonOptions& options) const;

 private:
  std::string name_, version_;
  Held type_;
  Schema schema_;
  PythonOptions defaults_;
};

/// While one lives, no class may become a member: other threads may look at the families.
class NoNewMembers {
 public:
  NoNewMembers();
  NoNewMembers(const NoNewMembers&) = delete;
  NoNewMembers& operator=(const NoNewMembers&) = delete;
  ~NoNewMembers();
};

/// Whether that member is a class of Python.
bool is_class(const std::string& family, const std::string& name);

/// Whether this process was given classes or functions, which no other program knows.
bool has_own_code();
void note_own_code();

/// Whether a name is one of a scenario or study: a to z, 0 to 9 and _.
bool can_be_written(const std::string& name);

/// Throws InputError if the name is that of a member which is no class of Python, or could not be
/// written in a scenario, and while there are NoNewMembers.
void require_free(const RegistryBase& registry, const std::string& name);

/// Makes a class a member, in place of an earlier one of its name. `wrap` makes a member of it.
template <class Family>
void put_class(
    const std::shared_ptr<const PythonClass>& type, const std::string& summary,
    std::function<std::unique_ptr<Family>(const PythonClass&, const PythonOptions&)> wrap) {
  Registry<Family>& registry = Registry<Family>::instance();
  require_free(registry, type->name());
  MemberInfo info{
      type->name(), summary, [type]() -> const Schema& { return type->schema(); },
      [type](const Setting& table, const std::string& path) { type->read(table, path); },
      [type](const Setting& table, const std::string& path) {
        const PythonOptions options = type->read(table, path);
        return write_options(type->schema(), &options);
      }};
  registry.put(std::move(info), [type, wrap](const Setting& table, const std::string& path) {
    return wrap(*type, type->read(table, path));
  });
}

// What each family does with a class.
using PutClass = void (*)(const std::shared_ptr<const PythonClass>& type,
                          const std::string& summary);
void put_behaviour(const std::shared_ptr<const PythonClass>& type, const std::string& summary);
void put_selection(const std::shared_ptr<const PythonClass>& type, const std::string& summary);
void put_guidance(const std::shared_ptr<const PythonClass>& type, const std::string& summary);
void put_solver(const std::shared_ptr<const PythonClass>& type, const std::string& summary);
void put_measure(const std::shared_ptr<const PythonClass>& type, const std::string& summary);

// What methods of these classes are handed.
void add_neighbourhoods(py::module_& module);
void add_solver_view(py::module_& module);

}  // namespace shoal::python
