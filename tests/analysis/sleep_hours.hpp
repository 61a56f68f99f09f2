#pragma once

#include <vector>

namespace shoal::analysis::statistics {

/// Student 1908: additional hours of sleep under two drugs, patient by patient; their differences.
inline const std::vector<double> sleep_hours{-1.2, -2.4, -1.3, -1.3, 0.0,
                                             -1.0, -1.8, -0.8, -4.6, -1.4};

}  // namespace shoal::analysis::statistics
