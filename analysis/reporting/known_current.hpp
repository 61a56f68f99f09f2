#pragma once

#include <span>

#include "shoal/scenarios/currents/current.hpp"

namespace shoal::analysis {

/// Current::sample(), but NaN where the current is not known, for maps that only show it.
void sample_known(const scenarios::Current& current, double time_s, std::span<const double> x_m,
                  std::span<const double> y_m, std::span<double> u_m_s, std::span<double> v_m_s);

}  // namespace shoal::analysis
