#pragma once

#include <limits>
#include <string>
#include <vector>

#include "shoal/scenarios/currents/netcdf_file.hpp"

namespace shoal::scenarios {

/// How a variable's stored numbers stand for values: value = stored * scale + offset, unless the
/// stored number says that there is none (NetCDF Users' Guide, appendix A; CF-1.8,
/// sec. 2.5.1, 8.1).
class Packing {
 public:
  /// Reads scale_factor, add_offset, _FillValue, missing_value, valid_min, valid_max, valid_range.
  Packing(const NetcdfFile& file, const NetcdfVariable& variable);

  /// NaN where the stored number means "missing".
  double value(double stored) const {
    for (const double missing : missing_) {
      if (stored == missing) return std::numeric_limits<double>::quiet_NaN();
    }
    // Comparisons are false for NaN, which so stays missing.
    if (!(stored >= stored_low_ && stored <= stored_high_)) {
      return std::numeric_limits<double>::quiet_NaN();
    }
    const double unpacked = stored * scale_ + offset_;
    return unpacked >= low_ && unpacked <= high_ ? unpacked
                                                 : std::numeric_limits<double>::quiet_NaN();
  }

  /// `int16 x 0.001 + 0.5`, or just the type.
  std::string text(const NetcdfVariable& variable) const;

 private:
  static constexpr double unlimited = std::numeric_limits<double>::infinity();

  double scale_ = 1.0;
  double offset_ = 0.0;
  bool packed_ = false;
  std::vector<double> missing_;  ///< stored numbers
  double stored_low_ = -unlimited, stored_high_ = unlimited;
  double low_ = -unlimited, high_ = unlimited;
};

/// All values of a variable, unpacked; refuses it if one is missing or infinite.
std::vector<double> complete_values(const NetcdfFile& file, const NetcdfVariable& variable);

}  // namespace shoal::scenarios
