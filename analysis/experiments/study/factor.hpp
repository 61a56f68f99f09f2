#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "shoal/core/options.hpp"

namespace shoal::analysis {

/// One level of a factor that changes several options at once.
struct Level {
  std::string label;
  std::string scenario;  ///< another base scenario, or "" for that of the group
  Setting set;           ///< changes to it
  Origin origin;

  static constexpr const char* noun = "a level";
  static void declare(Options<Level>& o);
  std::optional<std::string> complaint() const;
};

/// Something that a study varies: one option over values or a range, or linked options level by
/// level.
struct Factor {
  enum class Scale { linear, logarithmic };

  std::string name;           ///< heads its column; default: the last part of the key
  std::string key;            ///< the option (`ping.period_s`), or "" if there are levels
  Setting values;             ///< a list
  std::vector<double> range;  ///< lowest and highest; default: as the option declares
  std::int64_t steps = 0;     ///< how many values of the range, its ends among them
  Scale scale = Scale::linear;
  std::vector<Level> levels;
  Setting only;  ///< factor -> label or labels: where this factor applies
  Origin origin;

  static constexpr const char* noun = "a factor";
  static void declare(Options<Factor>& o);
  std::optional<std::string> complaint() const;
};

/// A factor as an axis to stand on.
class Axis {
 public:
  /// What is done to the scenario at one place of the axis.
  struct Place {
    std::string label;
    std::string scenario;  ///< another base, or ""
    Setting set;           ///< changes; the key alone where one option is varied
  };

  /// Throws InputError if the key is unknown, its range is not, or values are of a wrong kind.
  explicit Axis(const Factor& factor);

  const std::string& name() const { return name_; }
  const std::string& unit() const { return unit_; }
  /// What its option means; "" for levels that change several.
  const std::string& meaning() const { return meaning_; }
  /// 0 for a continuous axis.
  int levels() const { return static_cast<int>(places_.size()); }
  const Place& level(std::size_t i) const { return places_[i]; }
  /// u from 0 to 1: the place on a continuous axis, or the level it falls on.
  Place at(double u) const;

 private:
  void take_values(const Factor& factor);
  void take_range(const Factor& factor, const Option& option);
  double value_at(double u) const;
  Place place_of(Setting value) const;

  std::string name_, key_, unit_, meaning_;
  Origin origin_;
  std::vector<Place> places_;
  double low_ = 0.0, high_ = 0.0;
  Factor::Scale scale_ = Factor::Scale::linear;
  bool integer_ = false;
};

/// How a value is written in labels: `0.5`, `true`, `rigid_registration`. Throws InputError for
/// lists and tables.
std::string label_of(const Setting& value);

}  // namespace shoal::analysis
