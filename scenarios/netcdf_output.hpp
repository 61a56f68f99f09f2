#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "shoal/scenarios/netcdf_guard.hpp"

namespace shoal::scenarios {

/// A netCDF-4 file made in memory and written as a whole: HDF5 does not survive a full disk.
///
/// Holds a NetcdfGuard as long as it lives. Groups, dimensions and variables are handles of this
/// file. Every error is a SystemError that begins with `cannot make FILE`.
class NetcdfOutput {
 public:
  enum class Type : std::uint8_t { character, string, integer, single_float, double_float };
  struct Group {
    int id;
  };
  struct Dimension {
    int id;
  };
  struct Variable {
    int group, id;
  };

  explicit NetcdfOutput(const std::filesystem::path& path);
  ~NetcdfOutput();
  NetcdfOutput(const NetcdfOutput&) = delete;
  NetcdfOutput& operator=(const NetcdfOutput&) = delete;

  Group root() const { return {id_}; }
  Group group(Group parent, const std::string& name);

  /// `size` must not be 0, which would mean a dimension without end.
  Dimension dimension(Group group, const std::string& name, std::size_t size);

  /// With the attributes units (unless it is "") and long_name.
  Variable variable(Group group, const std::string& name, Type type,
                    const std::vector<Dimension>& dimensions, const std::string& unit,
                    const std::string& meaning);
  /// NaN stands where nothing is written, and says so. Of variables of floating numbers.
  void fill_with_nan(Variable variable);
  void compress(Variable variable);
  /// Stores the variable in blocks of this shape, one length a dimension.
  void store_in_blocks(Variable variable, const std::vector<std::size_t>& lengths);

  void text(Group group, const std::string& attribute, const std::string& value);
  void text(Variable variable, const std::string& attribute, const std::string& value);
  /// In the type of the variable.
  void numbers(Variable variable, const std::string& attribute, std::span<const double> values);

  /// All values of a variable, the last dimension running fastest.
  void put(Variable variable, std::span<const double> values);
  void put(Variable variable, std::span<const float> values);
  void put(Variable variable, std::span<const char> values);
  void put(Variable variable, const std::vector<std::string>& values);
  /// A block of values that begins at `start` and is as long as `count` in each dimension.
  void put_block(Variable variable, const std::vector<std::size_t>& start,
                 const std::vector<std::size_t>& count, std::span<const double> values);

  /// Writes the file, which appears under its name only when it is complete.
  void finish();

 private:
  void check(int code) const;
  void require_all_there(std::span<char> content) const;

  NetcdfGuard guard_;
  std::filesystem::path path_;
  int id_ = 0;
  bool open_ = false;
  int variables_ = 0, attributes_ = 0;  // that the file must hold in the end
};

}  // namespace shoal::scenarios
