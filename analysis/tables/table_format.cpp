#include "shoal/analysis/tables/table_format.hpp"

#include "shoal/core/text.hpp"

namespace shoal::analysis {

std::unique_ptr<TableFormat> table_format(const std::string& name) {
  const auto& formats = Registry<TableFormat>::instance();
  if (formats.find(name) != nullptr) return formats.make(name, Setting{}, name);
  throw InputError("there is no format \"" + name + '"' + suggestion(name, formats.names()));
}

}  // namespace shoal::analysis
