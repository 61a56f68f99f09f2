#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "shoal/core/registry.hpp"

namespace shoal::scenarios {

/// The motion of the water over ground.
///
/// Immutable once made, so that threads may share it. Files are read when it is made.
class Current {
 public:
  static constexpr const char* family = "current";
  static constexpr const char* family_meaning = "the motion of the water over ground";

  virtual ~Current() = default;

  /// Velocities (m/s, east and north) at positions (m, east and north of the origin) at one time
  /// (s since mission start), at the surface unless an option names another depth. All spans have
  /// the same length.
  ///
  /// Throws InputError, naming the limits, where there is no current (outside the data of a file).
  virtual void sample(double time_s, std::span<const double> x_m, std::span<const double> y_m,
                      std::span<double> u_m_s, std::span<double> v_m_s) const = 0;

  /// The same at the depths (m, positive down) of the positions. A current that knows nothing of
  /// depths is the same at all of them.
  virtual void sample_at(double time_s, std::span<const double> x_m, std::span<const double> y_m,
                         std::span<const double> depth_m, std::span<double> u_m_s,
                         std::span<double> v_m_s) const {
    (void)depth_m;
    sample(time_s, x_m, y_m, u_m_s, v_m_s);
  }

  /// Throws InputError if the current does not cover a mission of this length.
  virtual void require_duration(double duration_s) const { (void)duration_s; }
};

}  // namespace shoal::scenarios
