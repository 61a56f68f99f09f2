#include "shoal/analysis/reporting/known_current.hpp"

#include <limits>

#include "shoal/core/error.hpp"

namespace shoal::analysis {

void sample_known(const scenarios::Current& current, double time_s, std::span<const double> x_m,
                  std::span<const double> y_m, std::span<double> u_m_s, std::span<double> v_m_s) {
  try {
    current.sample(time_s, x_m, y_m, u_m_s, v_m_s);
    return;
  } catch (const InputError&) {  // somewhere it is not known: one place after the other
  }
  for (std::size_t k = 0; k < x_m.size(); ++k) {
    try {
      current.sample(time_s, x_m.subspan(k, 1), y_m.subspan(k, 1), u_m_s.subspan(k, 1),
                     v_m_s.subspan(k, 1));
    } catch (const InputError&) {
      u_m_s[k] = v_m_s[k] = std::numeric_limits<double>::quiet_NaN();
    }
  }
}

}  // namespace shoal::analysis
