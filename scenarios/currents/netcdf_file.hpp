#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "shoal/scenarios/netcdf_guard.hpp"

namespace shoal::scenarios {

struct NetcdfDimension {
  std::string name;
  std::size_t length = 0;

  bool operator==(const NetcdfDimension&) const = default;
};

struct NetcdfVariable {
  int id = 0;
  std::string name;
  std::string type;         ///< `int16`, `float32`, ... as numpy calls it
  bool is_numeric = false;  ///< neither characters nor strings nor a user's type
  bool is_integer = false;
  std::vector<NetcdfDimension> dimensions;

  std::size_t size() const;
};

/// One netCDF file, read only; read_netcdf() opens it.
///
/// Holds a NetcdfGuard as long as it lives: read, close, and work on what was read.
/// Every error is an InputError that begins with the name of the file.
class NetcdfFile {
 public:
  explicit NetcdfFile(const std::filesystem::path& path);
  ~NetcdfFile();
  NetcdfFile(const NetcdfFile&) = delete;
  NetcdfFile& operator=(const NetcdfFile&) = delete;

  /// The path as a message should show it.
  const std::string& name() const { return name_; }
  const std::vector<NetcdfVariable>& variables() const { return variables_; }
  /// nullptr if there is none.
  const NetcdfVariable* find(std::string_view name) const;

  /// A text attribute without surrounding blanks; "" if there is none.
  std::string text(const NetcdfVariable& variable, const char* attribute) const;

  /// A numeric attribute, of any type; empty if there is none.
  std::vector<double> numbers(const NetcdfVariable& variable, const char* attribute) const;
  /// Whether a numeric attribute is of a floating type.
  bool is_floating(const NetcdfVariable& variable, const char* attribute) const;

  /// The value that stands where nothing was written, if that can be told from data.
  std::optional<double> default_fill(const NetcdfVariable& variable) const;

  /// Values as stored (packed), of a block given by `start` and `count` for each dimension.
  void read(const NetcdfVariable& variable, const std::vector<std::size_t>& start,
            const std::vector<std::size_t>& count, std::vector<double>& values) const;

  /// Of memory that the file takes besides what is read of it: a classic one stands in memory, of
  /// others a chunk of a variable does, packed and unpacked.
  double bytes_beside(const NetcdfVariable& variable) const;
  /// Refuses to read what would take more than most_netcdf_bytes.
  void require_room(double bytes) const;

  [[noreturn]] void refuse(const std::string& why) const;

 private:
  void open(const std::filesystem::path& path);
  void list_variables();
  /// Throws if the status of a netCDF call is an error; `doing` completes "cannot ...".
  void require(int status, const std::string& doing) const;

  NetcdfGuard guard_;
  std::string name_;
  std::vector<char> content_;  ///< of a classic file
  int id_ = -1;
  std::vector<NetcdfVariable> variables_;
};

/// How a path is shown: relative to where the user stands if it is below, else in full.
std::string shown(const std::filesystem::path& path);

/// What `read` makes of a NetcdfFile. It is called twice, first in a child process: it must do
/// nothing but read. Throws InputError that begins with the name of the file.
template <class Read>
auto read_netcdf(const std::filesystem::path& path, const Read& read) {
  std::error_code error;  // the reading says it better
  const std::uintmax_t bytes = std::filesystem::file_size(path, error);
  if (!error) rehearse_netcdf(shown(path), bytes, [&] { read(NetcdfFile(path)); });
  return read(NetcdfFile(path));
}

}  // namespace shoal::scenarios
