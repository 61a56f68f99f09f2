#pragma once

#include <netcdf.h>

#include <cstddef>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace shoal::tests {

/// Writes a small netCDF file for a test, one variable after the other.
class NetcdfWriter {
 public:
  explicit NetcdfWriter(const std::filesystem::path& path, int format = NC_64BIT_OFFSET) {
    require(nc_create(path.c_str(), NC_CLOBBER | format, &id_));
    // Prefilling would insist on a _FillValue of the variable's own type; real files have others.
    require(nc_set_fill(id_, NC_NOFILL, nullptr));
  }
  ~NetcdfWriter() { nc_close(id_); }
  NetcdfWriter(const NetcdfWriter&) = delete;
  NetcdfWriter& operator=(const NetcdfWriter&) = delete;

  NetcdfWriter& dimension(const std::string& name, std::size_t length) {
    int dimension = 0;
    require(nc_def_dim(id_, name.c_str(), length, &dimension));
    return *this;
  }

  /// Values are stored as they are, converted to the type; `dimensions` by name.
  NetcdfWriter& variable(const std::string& name, nc_type type,
                         const std::vector<std::string>& dimensions,
                         const std::vector<double>& values) {
    std::vector<int> ids(dimensions.size());
    for (std::size_t d = 0; d < ids.size(); ++d) {
      require(nc_inq_dimid(id_, dimensions[d].c_str(), &ids[d]));
    }
    int variable = 0;
    require(
        nc_def_var(id_, name.c_str(), type, static_cast<int>(ids.size()), ids.data(), &variable));
    pending_.emplace_back(variable, values);
    return *this;
  }

  /// An attribute of the variable defined last.
  NetcdfWriter& text(const std::string& name, const std::string& text) {
    const int variable = pending_.back().first;
    require(nc_put_att_text(id_, variable, name.c_str(), text.size(), text.c_str()));
    return *this;
  }
  NetcdfWriter& number(const std::string& name, nc_type type, const std::vector<double>& values) {
    const int variable = pending_.back().first;
    require(nc_put_att_double(id_, variable, name.c_str(), type, values.size(), values.data()));
    return *this;
  }

  void finish() {
    require(nc_enddef(id_));
    for (const auto& [variable, values] : pending_) {
      require(nc_put_var_double(id_, variable, values.data()));
    }
    require(nc_sync(id_));
  }

 private:
  static void require(int status) {
    if (status != NC_NOERR) throw std::runtime_error(nc_strerror(status));
  }

  int id_ = -1;
  std::vector<std::pair<int, std::vector<double>>> pending_;
};

}  // namespace shoal::tests
