#include "shoal/scenarios/currents/netcdf_file.hpp"

#include <fcntl.h>
#include <netcdf.h>
#include <netcdf_mem.h>
#include <unistd.h>

#include <cmath>
#include <fstream>

#include "shoal/core/error.hpp"
#include "shoal/core/text.hpp"

namespace shoal::scenarios {
namespace {

struct TypeName {
  nc_type type;
  const char* name;
  bool is_integer;
};

constexpr TypeName numeric_types[] = {{NC_BYTE, "int8", true},      {NC_UBYTE, "uint8", true},
                                      {NC_SHORT, "int16", true},    {NC_USHORT, "uint16", true},
                                      {NC_INT, "int32", true},      {NC_UINT, "uint32", true},
                                      {NC_INT64, "int64", true},    {NC_UINT64, "uint64", true},
                                      {NC_FLOAT, "float32", false}, {NC_DOUBLE, "float64", false}};

bool is_classic(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  char magic[3] = {};
  file.read(magic, sizeof magic);
  return std::string_view(magic, sizeof magic) == "CDF";
}

}  // namespace

std::string shown(const std::filesystem::path& path) {
  std::error_code ignored;
  const auto near = path.lexically_proximate(std::filesystem::current_path(ignored));
  return near.empty() || *near.begin() == ".." ? path.string() : near.string();
}

std::size_t NetcdfVariable::size() const {
  std::size_t product = 1;
  for (const NetcdfDimension& dimension : dimensions) product *= dimension.length;
  return product;
}

NetcdfFile::NetcdfFile(const std::filesystem::path& path) : name_(shown(path)) {
  open(path);
  try {
    list_variables();
  } catch (...) {
    nc_close(id_);
    throw;
  }
}

NetcdfFile::~NetcdfFile() {
  nc_close(id_);
}

void NetcdfFile::open(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) refuse("there is no such file");
  int status = NC_NOERR;
  if (is_classic(path)) {
    // Read from disk, the missing end of a truncated classic file would silently read as zeros;
    // read from memory it is an error.
    require_room(static_cast<double>(std::filesystem::file_size(path)));
    std::ifstream file(path, std::ios::binary);
    content_.resize(std::filesystem::file_size(path));
    file.read(content_.data(), static_cast<std::streamsize>(content_.size()));
    if (!file) refuse("cannot be read");
    status = nc_open_mem(name_.c_str(), NC_NOWRITE, content_.size(), content_.data(), &id_);
  } else {
    // By a name of the system: the library would change one with blanks or backslashes.
    const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor < 0) refuse("cannot be read");
    const std::string name = "/proc/self/fd/" + std::to_string(descriptor);
    status = nc_open(name.c_str(), NC_NOWRITE, &id_);
    ::close(descriptor);
  }
  if (status == NC_ENOTNC) refuse("is not a netCDF file");
  require(status, "open the file; it is damaged or incomplete");
}

void NetcdfFile::list_variables() {
  int count = 0;
  require(nc_inq_nvars(id_, &count), "list the variables");
  for (int id = 0; id < count; ++id) {
    char name[NC_MAX_NAME + 1] = {};
    nc_type type = NC_NAT;
    int dimension_count = 0;
    int dimension_ids[NC_MAX_VAR_DIMS];
    require(nc_inq_var(id_, id, name, &type, &dimension_count, dimension_ids, nullptr),
            "list the variables");
    NetcdfVariable variable{.id = id, .name = name, .type = "text"};
    for (const TypeName& known : numeric_types) {
      if (known.type != type) continue;
      variable.type = known.name;
      variable.is_numeric = true;
      variable.is_integer = known.is_integer;
    }
    for (int d = 0; d < dimension_count; ++d) {
      std::size_t length = 0;
      require(nc_inq_dim(id_, dimension_ids[d], name, &length), "list the dimensions");
      variable.dimensions.push_back({name, length});
    }
    variables_.push_back(std::move(variable));
  }
}

const NetcdfVariable* NetcdfFile::find(std::string_view name) const {
  for (const NetcdfVariable& variable : variables_) {
    if (variable.name == name) return &variable;
  }
  return nullptr;
}

std::string NetcdfFile::text(const NetcdfVariable& variable, const char* attribute) const {
  nc_type type = NC_NAT;
  std::size_t length = 0;
  const int status = nc_inq_att(id_, variable.id, attribute, &type, &length);
  if (status == NC_ENOTATT) return "";
  const std::string what = variable.name + ":" + attribute;
  require(status, "read " + what);
  if (type == NC_CHAR) {
    std::string text(length, '\0');
    require(nc_get_att_text(id_, variable.id, attribute, text.data()), "read " + what);
    return std::string(trimmed(text.substr(0, text.find('\0'))));
  }
  if (type == NC_STRING && length == 1) {
    char* given = nullptr;
    require(nc_get_att_string(id_, variable.id, attribute, &given), "read " + what);
    const std::string text(trimmed(given ? given : ""));
    nc_free_string(1, &given);
    return text;
  }
  refuse(what + " is not text");
}

std::vector<double> NetcdfFile::numbers(const NetcdfVariable& variable,
                                        const char* attribute) const {
  nc_type type = NC_NAT;
  std::size_t length = 0;
  const int status = nc_inq_att(id_, variable.id, attribute, &type, &length);
  if (status == NC_ENOTATT) return {};
  const std::string what = variable.name + ":" + attribute;
  require(status, "read " + what);
  if (type == NC_CHAR || type == NC_STRING) refuse(what + " is text; it takes a number");
  std::vector<double> numbers(length);
  require(nc_get_att_double(id_, variable.id, attribute, numbers.data()), "read " + what);
  return numbers;
}

bool NetcdfFile::is_floating(const NetcdfVariable& variable, const char* attribute) const {
  nc_type type = NC_NAT;
  return nc_inq_atttype(id_, variable.id, attribute, &type) == NC_NOERR &&
         (type == NC_FLOAT || type == NC_DOUBLE);
}

std::optional<double> NetcdfFile::default_fill(const NetcdfVariable& variable) const {
  nc_type type = NC_NAT;
  require(nc_inq_vartype(id_, variable.id, &type), "read the type of " + variable.name);
  switch (type) {
    case NC_SHORT:
      return NC_FILL_SHORT;
    case NC_USHORT:
      return NC_FILL_USHORT;
    case NC_INT:
      return NC_FILL_INT;
    case NC_UINT:
      return NC_FILL_UINT;
    case NC_INT64:
      return static_cast<double>(NC_FILL_INT64);
    case NC_UINT64:
      return static_cast<double>(NC_FILL_UINT64);
    case NC_FLOAT:
      return static_cast<double>(NC_FILL_FLOAT);
    case NC_DOUBLE:
      return NC_FILL_DOUBLE;
    default:
      return std::nullopt;  // a byte has no value to spare
  }
}

void NetcdfFile::read(const NetcdfVariable& variable, const std::vector<std::size_t>& start,
                      const std::vector<std::size_t>& count, std::vector<double>& values) const {
  // What a file claims to hold may be more than what stands in it.
  double size = 1.0;
  for (const std::size_t n : count) size *= static_cast<double>(n);
  require_room(size * sizeof(double));
  values.resize(static_cast<std::size_t>(size));
  require(nc_get_vara_double(id_, variable.id, start.data(), count.data(), values.data()),
          "read " + variable.name + "; the file is damaged or incomplete");
}

double NetcdfFile::bytes_beside(const NetcdfVariable& variable) const {
  int storage = NC_CONTIGUOUS;
  std::size_t lengths[NC_MAX_VAR_DIMS] = {};
  double bytes = static_cast<double>(content_.size());
  if (nc_inq_var_chunking(id_, variable.id, &storage, lengths) != NC_NOERR) return bytes;
  if (storage != NC_CHUNKED) return bytes;
  double chunk = 2.0 * sizeof(double);
  for (std::size_t d = 0; d < variable.dimensions.size(); ++d) {
    chunk *= static_cast<double>(lengths[d]);
  }
  return bytes + chunk;
}

void NetcdfFile::require_room(double bytes) const {
  if (bytes <= static_cast<double>(most_netcdf_bytes)) return;
  constexpr double megabyte = 1e6;
  refuse("to read it takes " + shortest(std::ceil(bytes / megabyte)) + " MB of memory, and " +
         shortest(most_netcdf_bytes / megabyte) +
         " MB are the most; cut it to the region and the times that are needed");
}

void NetcdfFile::refuse(const std::string& why) const {
  throw InputError(name_ + ": " + why);
}

void NetcdfFile::require(int status, const std::string& doing) const {
  if (status != NC_NOERR) refuse("cannot " + doing + " (" + nc_strerror(status) + ")");
}

}  // namespace shoal::scenarios
