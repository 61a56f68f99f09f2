#include "shoal/scenarios/netcdf_output.hpp"

#include <netcdf.h>
#include <netcdf_mem.h>

#include <cstdlib>
#include <limits>
#include <memory>

#include "shoal/core/error.hpp"
#include "shoal/core/whole_file.hpp"
#include "shoal/scenarios/currents/netcdf_file.hpp"

namespace shoal::scenarios {
namespace {

nc_type netcdf_type(NetcdfOutput::Type type) {
  switch (type) {
    case NetcdfOutput::Type::character:
      return NC_CHAR;
    case NetcdfOutput::Type::string:
      return NC_STRING;
    case NetcdfOutput::Type::integer:
      return NC_INT;
    case NetcdfOutput::Type::single_float:
      return NC_FLOAT;
    case NetcdfOutput::Type::double_float:
      return NC_DOUBLE;
  }
  return NC_NAT;
}

struct Tally {
  int variables = 0, attributes = 0;
};

/// Of a group and those in it.
void count(int group, Tally& tally) {
  int variables = 0, attributes = 0, groups = 0;
  nc_inq_nvars(group, &variables);
  nc_inq_natts(group, &attributes);
  tally.variables += variables;
  tally.attributes += attributes;
  for (int v = 0; v < variables; ++v) {
    nc_inq_varnatts(group, v, &attributes);
    tally.attributes += attributes;
  }
  nc_inq_grps(group, &groups, nullptr);
  std::vector<int> ids(static_cast<std::size_t>(groups));
  nc_inq_grps(group, &groups, ids.data());
  for (const int id : ids) count(id, tally);
}

}  // namespace

NetcdfOutput::NetcdfOutput(const std::filesystem::path& path) : path_(path) {
  constexpr std::size_t initial_bytes = 1 << 20;
  // The library would change a name with blanks or backslashes; in memory it needs none.
  check(nc_create_mem("shoal", NC_NETCDF4, initial_bytes, &id_));
  open_ = true;
}

NetcdfOutput::~NetcdfOutput() {
  if (open_) nc_abort(id_);
}

void NetcdfOutput::check(int code) const {
  if (code == NC_NOERR) return;
  throw SystemError("cannot make " + path_.string() + ": " + nc_strerror(code));
}

NetcdfOutput::Group NetcdfOutput::group(Group parent, const std::string& name) {
  Group made{};
  check(nc_def_grp(parent.id, name.c_str(), &made.id));
  return made;
}

NetcdfOutput::Dimension NetcdfOutput::dimension(Group group, const std::string& name,
                                                std::size_t size) {
  Dimension made{};
  check(nc_def_dim(group.id, name.c_str(), size, &made.id));
  return made;
}

NetcdfOutput::Variable NetcdfOutput::variable(Group group, const std::string& name, Type type,
                                              const std::vector<Dimension>& dimensions,
                                              const std::string& unit, const std::string& meaning) {
  std::vector<int> ids;
  for (const Dimension& dimension : dimensions) ids.push_back(dimension.id);
  Variable made{group.id, 0};
  ++variables_;
  check(nc_def_var(group.id, name.c_str(), netcdf_type(type), static_cast<int>(ids.size()),
                   ids.data(), &made.id));
  if (!unit.empty()) text(made, "units", unit);
  text(made, "long_name", meaning);
  return made;
}

void NetcdfOutput::fill_with_nan(Variable variable) {
  nc_type type = NC_NAT;
  check(nc_inq_vartype(variable.group, variable.id, &type));
  const float single_nan = std::numeric_limits<float>::quiet_NaN();
  const double double_nan = std::numeric_limits<double>::quiet_NaN();
  const void* nan = type == NC_FLOAT ? static_cast<const void*>(&single_nan) : &double_nan;
  ++attributes_;
  check(nc_def_var_fill(variable.group, variable.id, NC_FILL, nan));
}

void NetcdfOutput::compress(Variable variable) {
  check(nc_def_var_deflate(variable.group, variable.id, 1, 1, 1));
}

void NetcdfOutput::store_in_blocks(Variable variable, const std::vector<std::size_t>& lengths) {
  check(nc_def_var_chunking(variable.group, variable.id, NC_CHUNKED, lengths.data()));
}

void NetcdfOutput::text(Group group, const std::string& attribute, const std::string& value) {
  ++attributes_;
  check(nc_put_att_text(group.id, NC_GLOBAL, attribute.c_str(), value.size(), value.c_str()));
}

void NetcdfOutput::text(Variable variable, const std::string& attribute, const std::string& value) {
  ++attributes_;
  check(
      nc_put_att_text(variable.group, variable.id, attribute.c_str(), value.size(), value.c_str()));
}

void NetcdfOutput::numbers(Variable variable, const std::string& attribute,
                           std::span<const double> values) {
  nc_type type = NC_NAT;
  check(nc_inq_vartype(variable.group, variable.id, &type));
  ++attributes_;
  check(nc_put_att_double(variable.group, variable.id, attribute.c_str(), type, values.size(),
                          values.data()));
}

void NetcdfOutput::put(Variable variable, std::span<const double> values) {
  check(nc_put_var_double(variable.group, variable.id, values.data()));
}

void NetcdfOutput::put(Variable variable, std::span<const float> values) {
  check(nc_put_var_float(variable.group, variable.id, values.data()));
}

void NetcdfOutput::put(Variable variable, std::span<const char> values) {
  check(nc_put_var_text(variable.group, variable.id, values.data()));
}

void NetcdfOutput::put(Variable variable, const std::vector<std::string>& values) {
  std::vector<const char*> texts;
  for (const std::string& value : values) texts.push_back(value.c_str());
  check(nc_put_var_string(variable.group, variable.id, texts.data()));
}

void NetcdfOutput::put_block(Variable variable, const std::vector<std::size_t>& start,
                             const std::vector<std::size_t>& count,
                             std::span<const double> values) {
  check(nc_put_vara_double(variable.group, variable.id, start.data(), count.data(), values.data()));
}

// Where memory ends for a moment, the libraries leave variables and attributes out of the file and
// report success.
void NetcdfOutput::require_all_there(std::span<char> content) const {
  int id = 0;
  check(nc_open_mem("shoal", NC_NOWRITE, content.size(), content.data(), &id));
  Tally found;
  count(id, found);
  nc_close(id);
  if (found.variables != variables_ || found.attributes != attributes_) check(NC_ENOMEM);
}

void NetcdfOutput::finish() {
  open_ = false;
  NC_memio content{};
  check(nc_close_memio(id_, &content));
  const std::unique_ptr<void, decltype(&std::free)> owned(content.memory, &std::free);
  require_all_there({static_cast<char*>(content.memory), content.size});
  write_whole_file(path_, {static_cast<const char*>(content.memory), content.size});
}

}  // namespace shoal::scenarios
