#include "conversions.hpp"
#include "shoal/analysis/experiments/measure.hpp"
#include "shoal/analysis/experiments/study/study.hpp"
#include "shoal/core/option_place.hpp"
#include "shoal/scenarios/inheritance.hpp"
#include "shoal/scenarios/library_path.hpp"
#include "shoal/scenarios/scenario.hpp"

namespace shoal::python {
namespace {

py::dict quantities(const std::vector<analysis::Quantity>& all) {
  py::dict described;
  for (const analysis::Quantity& each : all) {
    described[py::str(each.name)] = py::make_tuple(each.unit, each.meaning);
  }
  return described;
}

void add_options(const Schema& schema, const Setting& defaults, const std::string& path,
                 py::list& rows) {
  for (const Option& option : schema.options) {
    const std::string key = path + "." + option.name;
    const Setting& fallback = *defaults.find(option.name);
    if (option.table) {
      add_options(*option.table, fallback, key, rows);
      continue;
    }
    py::dict row;
    row["key"] = option.choice ? key + ".kind" : key;
    row["default"] = to_python(option.choice ? *fallback.find("kind") : fallback);
    row["unit"] = option.unit;
    row["range"] = option.type == "a number" || option.type == "an integer" ? option.range_text()
                                                                            : option.type;
    row["meaning"] = option.meaning;
    rows.append(row);
  }
}

py::list options_of(const std::string& family, const std::string& name) {
  for (const RegistryBase* each : families()) {
    if (each->family() != family) continue;
    const MemberInfo& member = each->members()[each->index_of(name, {}, family)];
    py::list rows;
    const std::string where = key_of(*each, schema_of<scenarios::Scenario>());
    add_options(member.schema(), member.schema().defaults,
                (where.empty() ? family : where) + "." + member.name, rows);
    return rows;
  }
  throw InputError("there is no family \"" + family + "\"; shoal.catalogue() names them");
}

}  // namespace

void add_catalogue(py::module_& module) {
  module.def("members", [] {
    py::dict all;
    for (const RegistryBase* family : families()) {
      py::dict members;
      for (const MemberInfo& member : family->members()) {
        members[py::str(member.name)] = member.summary;
      }
      all[py::str(family->family())] = members;
    }
    return all;
  });
  module.def("options", &options_of, py::arg("family"), py::arg("name"));
  module.def("scenarios", &scenarios::library_scenarios);
  module.def("sets", [] {
    py::dict all;
    for (const std::string& name : scenarios::library_sets()) {
      all[py::str(name)] = scenarios::set_summary(name);
    }
    return all;
  });
  module.def("studies", &analysis::library_studies);
  module.def("measures", [] { return quantities(analysis::known_values()); });
  module.def("series", [] { return quantities(analysis::known_series()); });
}

}  // namespace shoal::python
