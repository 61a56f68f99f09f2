#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>

#include "shoal/analysis/experiments/measure.hpp"
#include "shoal/core/angles.hpp"
#include "shoal/scenarios/estimators/estimator.hpp"

namespace shoal::analysis {
namespace {

/// How well vehicles know their states, and how well they know how well: of vehicles that estimate.
///
/// NEES, the error squared and normalised by the believed covariance, is chi-squared for a
/// consistent filter, with as many degrees of freedom as there are estimated states: as many in the
/// mean, and 95 % of it in the band between its 2.5 % and 97.5 % points (Bar-Shalom, Li and
/// Kirubarajan 2001, sec. 5.4).
class Estimation final : public Measure {
 public:
  static void declare(Options<Estimation>&) {}

  std::vector<Quantity> values() const override {
    return {
        {"position_error_rms_m", "m", "error of the believed position, rms"},
        {"speed_error_rms_m_s", "m/s", "error of the believed forward speed, rms"},
        {"heading_error_rms_deg", "deg", "error of the believed heading, rms"},
        {"current_error_rms_m_s", "m/s", "error of the believed velocity of the water, rms"},
        {"nees_mean", "",
         "normalised error of the whole state; if the filter is consistent, as many as there are "
         "states: 14, or 12 where the current is not estimated"},
        {"nees_per_state", "", "the same over the number of states; 1 if consistent"},
        {"nees_inside_share", "", "share of it inside its 95 % band"},
        {"fault_share", "", "measurements missing, of all"},
        {"outlier_share", "", "measurements rejected as outliers, of all"}};
  }

  void begin(const scenarios::World& world) override {
    if (world.size() > 0 && world.swarm().estimate(0)) every_s_ = log_interval_s(world);
  }

  void observe(const scenarios::World& world) override {
    for (std::size_t i = 0; i < world.size(); ++i) {
      if (world.lost(i)) continue;
      const scenarios::Swarm& swarm = world.swarm();
      const formations::OwnState own = swarm.own_state(i);
      const Eigen::Vector2d truth(swarm.x_m[i], swarm.y_m[i]);
      const double turned = wrapped(own.heading_rad - swarm.heading_rad[i]);
      position_ += (own.position - truth).squaredNorm();
      speed_ += square(own.speed_m_s - swarm.speed_m_s[i]);
      heading_ += square(turned);
      ++looks_;

      const scenarios::Estimate& estimate = *swarm.estimate(i);
      const Eigen::Vector2d water = swarm.water_m_s(i);
      current_ += (Eigen::Vector2d(estimate.water.y(), estimate.water.x()) - water).squaredNorm();
      faults_ += static_cast<double>(estimate.faulty.count());
      outliers_ += static_cast<double>(estimate.rejected.count());
      if (world.time_s() == 0.0 || !std::isfinite(estimate.nees)) continue;  // nothing filtered yet
      nees_ += estimate.nees;
      const Band& band = estimate.estimated == 14 ? with_water_ : without_;
      states_ = estimate.estimated;
      inside_ += estimate.nees >= band.low && estimate.nees <= band.high ? 1 : 0;
      ++filtered_;
    }
  }

  void finish(const scenarios::World&, Results& results) const override {
    const auto mean = [](double sum, int count) {
      return count > 0 ? std::optional(sum / count) : std::nullopt;
    };
    const auto rms = [&](double squares) {
      const auto of = mean(squares, looks_);
      return of ? std::optional(std::sqrt(*of)) : std::nullopt;
    };
    results.add("position_error_rms_m", rms(position_));
    results.add("speed_error_rms_m_s", rms(speed_));
    const auto turned = rms(heading_);
    results.add("heading_error_rms_deg", turned ? std::optional(degrees(*turned)) : std::nullopt);
    results.add("current_error_rms_m_s", rms(current_));
    results.add("nees_mean", mean(nees_, filtered_));
    results.add("nees_per_state", mean(nees_ / states_, filtered_));
    results.add("nees_inside_share", mean(inside_, filtered_));
    results.add("fault_share", mean(faults_ / measurements, looks_));
    results.add("outlier_share", mean(outliers_ / measurements, looks_));
  }

 private:
  static constexpr double measurements = 12.0;
  struct Band {
    double low, high;

    explicit Band(double states)
        : low(quantile(boost::math::chi_squared(states), 0.025)),
          high(quantile(boost::math::chi_squared(states), 0.975)) {}
  };
  static double square(double x) { return x * x; }

  Band without_{12}, with_water_{14};
  double states_ = 12;
  double current_ = 0.0, position_ = 0.0, speed_ = 0.0, heading_ = 0.0, nees_ = 0.0, inside_ = 0.0;
  double faults_ = 0.0, outliers_ = 0.0;
  int looks_ = 0, filtered_ = 0;
};

const Register<Measure, Estimation> registered{"estimation",
                                               "how well vehicles know their own states"};

}  // namespace
}  // namespace shoal::analysis
