#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>

namespace shoal::scenarios {

/// How the rate limits of noise are meant. The chapter prints n_i / T, which grows as T shrinks; a
/// rate times T is a step (C53). Its numbers may also be meant as steps already.
enum class RateLimit { per_second, per_sample };

/// What a rate limit is multiplied by to be the largest change between samples `period_s` apart.
inline double step_per_rate(RateLimit meaning, double period_s) {
  return meaning == RateLimit::per_second ? period_s : 1.0;
}

/// Barisic et al. 2011, eq. 64 with C53: towards `wanted`, but no further than a step.
inline double rate_limited(double before, double wanted, double step) {
  return before + std::clamp(wanted - before, -step, step);
}

/// A normal distribution and how fast a sample of it may follow: (mu, sigma, n).
struct Grade {
  double mean;
  double sd;
  double rate;  ///< largest change per second, or per sample: RateLimit
};

/// A noise that switches between six states as a Markov chain: nominal, +reliable, -reliable,
/// +unreliable, -unreliable, fault. Source: Barisic et al. 2011, sec. 5.3.
class GaussMarkov {
 public:
  using Matrix = Eigen::Matrix<double, 6, 6>;
  using Shares = Eigen::Matrix<double, 6, 1>;
  static constexpr int fault = 5;

  /// Where a channel stands.
  struct Channel {
    int state = 0;
    double value = 0.0;
  };

  /// Grades with the sign of the + states; `transition(i, j)` is the chance to go from i to j at a
  /// sample. Rows are renormalised: printed ones add up to 1 within their four digits only. Throws
  /// InputError if an entry is negative or a row is off by more than 0.001.
  GaussMarkov(const Grade& nominal, const Grade& reliable, const Grade& unreliable,
              const Matrix& transition);

  /// The same noise without faults.
  GaussMarkov without_faults() const;

  const Matrix& transition() const { return transition_; }
  const std::array<Grade, 5>& grades() const { return grades_; }

  /// The share of samples that each state holds in the long run.
  Shares stationary() const;

  /// The next sample, from one uniform and one standard normal number; NaN in a fault, after which
  /// the value starts from 0 again. `steps` is what step_per_rate() says.
  double next(Channel& channel, double uniform, double normal, double steps) const;

 private:
  std::array<Grade, 5> grades_;
  Matrix transition_;
};

}  // namespace shoal::scenarios
