#include "shoal/scenarios/currents/netcdf_values.hpp"

#include <cmath>

#include "shoal/core/text.hpp"

namespace shoal::scenarios {
namespace {

/// The attribute as the variable's type would hold it: a float32 variable stores 1e20 as
/// 1.00000002e20, whatever the attribute's own type says.
double as_stored(double number, const NetcdfVariable& variable) {
  return variable.type == "float32" ? static_cast<double>(static_cast<float>(number)) : number;
}

double one_number(const NetcdfFile& file, const NetcdfVariable& variable, const char* attribute,
                  double otherwise) {
  const std::vector<double> given = file.numbers(variable, attribute);
  if (given.empty()) return otherwise;
  if (given.size() != 1 || !std::isfinite(given[0])) {
    file.refuse(variable.name + ":" + attribute + " is not one finite number");
  }
  return given[0];
}

}  // namespace

Packing::Packing(const NetcdfFile& file, const NetcdfVariable& variable) {
  if (!variable.is_numeric) file.refuse(variable.name + " does not hold numbers");
  if (file.text(variable, "_Unsigned") == "true") {
    file.refuse(variable.name +
                " is stored by the _Unsigned convention, which shoal does not read"
                "; convert it to a signed or netCDF-4 unsigned type");
  }
  scale_ = one_number(file, variable, "scale_factor", 1.0);
  offset_ = one_number(file, variable, "add_offset", 0.0);
  if (scale_ == 0.0) file.refuse(variable.name + ":scale_factor is 0");
  packed_ = scale_ != 1.0 || offset_ != 0.0;

  const std::vector<double> fill = file.numbers(variable, "_FillValue");
  for (const double number : fill) missing_.push_back(as_stored(number, variable));
  for (const double number : file.numbers(variable, "missing_value")) {
    missing_.push_back(as_stored(number, variable));
  }
  if (fill.empty()) {
    if (const auto number = file.default_fill(variable)) missing_.push_back(*number);
  }

  const auto limit = [&](const char* attribute, double number, bool upper) {
    // Users' Guide: a limit of the unpacked type on a packed variable bounds the unpacked values.
    const bool of_unpacked =
        packed_ && variable.is_integer && file.is_floating(variable, attribute);
    if (of_unpacked) {
      (upper ? high_ : low_) = number;
    } else {
      (upper ? stored_high_ : stored_low_) = as_stored(number, variable);
    }
  };
  const std::vector<double> range = file.numbers(variable, "valid_range");
  if (!range.empty()) {
    if (range.size() != 2) file.refuse(variable.name + ":valid_range is not a pair of numbers");
    limit("valid_range", range[0], false);
    limit("valid_range", range[1], true);
  }
  if (!file.numbers(variable, "valid_min").empty()) {
    limit("valid_min", one_number(file, variable, "valid_min", 0.0), false);
  }
  if (!file.numbers(variable, "valid_max").empty()) {
    limit("valid_max", one_number(file, variable, "valid_max", 0.0), true);
  }
}

std::string Packing::text(const NetcdfVariable& variable) const {
  if (!packed_) return variable.type;
  const char* sign = offset_ < 0.0 ? " - " : " + ";
  return variable.type + " x " + shortest(scale_) +
         (offset_ != 0.0 ? sign + shortest(std::abs(offset_)) : "");
}

std::vector<double> complete_values(const NetcdfFile& file, const NetcdfVariable& variable) {
  const Packing packing(file, variable);
  std::vector<std::size_t> count;
  for (const NetcdfDimension& dimension : variable.dimensions) count.push_back(dimension.length);
  std::vector<double> values;
  file.read(variable, std::vector<std::size_t>(count.size(), 0), count, values);
  for (double& value : values) {
    value = packing.value(value);
    if (!std::isfinite(value)) file.refuse(variable.name + " has missing or infinite values");
  }
  return values;
}

}  // namespace shoal::scenarios
