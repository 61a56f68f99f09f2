#include "shoal/analysis/experiments/measures/quality_history.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

namespace shoal::analysis {
namespace {

constexpr double mission_s = 7200.0;
using std::numbers::pi;

/// A quality that is a function of time, looked at every 5 s.
struct Sampled {
  std::vector<double> time_s, quality_m;

  explicit Sampled(const std::function<double(double)>& quality, double duration_s = mission_s) {
    for (double t = 0.0; t <= duration_s; t += 5.0) {
      time_s.push_back(t);
      quality_m.push_back(quality(t));
    }
  }
  QualityHistory history() const { return {time_s, quality_m, time_s.back()}; }
};

double wave(double t, double period_s) {
  return std::sin(2.0 * pi * t / period_s);
}

TEST(QualityHistory, LooksAtTheShareOfTheMissionAskedFor) {
  const Sampled step([](double t) {
    return t < 0.4 * mission_s ? 100.0 : t < 7000.0 ? 8.0 : 12.0;
  });
  EXPECT_NEAR(*step.history().mean_m(0.0), (576 * 100.0 + 824 * 8.0 + 41 * 12.0) / 1441, 1e-9);
  EXPECT_NEAR(*step.history().mean_m(0.4), (824 * 8.0 + 41 * 12.0) / 865, 1e-9);
  EXPECT_EQ(step.history().worst_m(0.0), 100.0);
  EXPECT_EQ(step.history().worst_m(0.4), 12.0);
  EXPECT_EQ(step.history().mean_m(1.0), 12.0);
}

TEST(QualityHistory, HasTheTrendOfItsLeastSquaresLine) {
  EXPECT_NEAR(
      *Sampled([](double t) { return 5.0 - 3.0 * t / 3600.0; }).history().trend_m_per_h(0.4), -3.0,
      1e-9);
  // By hand: times -5, 0, 5 s about their mean, values 0, 3, 3; 15 / 50 m/s.
  const std::vector<double> time_s = {0, 5, 10}, quality_m = {0, 3, 3};
  EXPECT_NEAR(*QualityHistory(time_s, quality_m, 10.0).trend_m_per_h(0.0), 3600.0 * 15.0 / 50.0,
              1e-9);
}

TEST(QualityHistory, SwingsAsAWaveDoes) {
  // The window holds 121 looks, ten periods of 12 looks and one more: the mean is 1/121 of it. It
  // fits around 1321 looks, 110 periods and one more where the wave is at rest.
  const Sampled wavy([](double t) { return 20.0 + 4.0 * wave(t, 60.0); });
  EXPECT_NEAR(*wavy.history().oscillation_m(), 4.0 * 120.0 / 121.0 * std::sqrt(660.0 / 1321.0),
              1e-9);
}

TEST(QualityHistory, DoesNotTakeADriftForASwing) {
  EXPECT_NEAR(*Sampled([](double t) { return 10.0 + t / 100.0; }).history().oscillation_m(), 0.0,
              1e-9);
  // Of a slow wave the mean over w = 600 s leaves all but sin(pi w/T)/(pi w/T): 0.4 % at two hours.
  const Sampled slow([](double t) { return 20.0 + 4.0 * wave(t, 7200.0); });
  EXPECT_LT(*slow.history().oscillation_m(), 0.02 * 4.0 / std::sqrt(2.0));
}

TEST(QualityHistory, DoesNotTakeTheFormingForASwing) {
  const Sampled forming([](double t) { return t < 1000.0 ? 400.0 - 0.39 * t : 10.0; });
  EXPECT_LT(*forming.history().oscillation_m(), 0.05);
  const Sampled jumping([](double t) { return t < 1000.0 ? 400.0 : 10.0; });
  EXPECT_NEAR(*jumping.history().oscillation_m(), 0.0, 1e-12);
}

TEST(QualityHistory, RisesAndFallsAgainAsAWaveThatDiesOut) {
  // Formed at 990 s, and from 1000 s five waves of 2 m about 10 m, 20 m up and 20 m down in all.
  // The ten minutes end 10 s before them, in the rise to the mean by 1 m: 2 m sin(30 deg).
  const auto wavy = [](double t) {
    return t < 1000.0 ? 400.0 - 0.39 * t : t < 1600.0 ? 10.0 + 2.0 * wave(t - 1000.0, 120.0) : 10.0;
  };
  EXPECT_NEAR(*Sampled(wavy).history().swing_m(), 19.0, 1e-9);
  // What comes later does not count: vehicles that keep their places make waves, too.
  const Sampled later([&](double t) { return t < 2000.0 ? wavy(t) : 10.0 + wave(t, 120.0); });
  EXPECT_NEAR(*later.history().swing_m(), 19.0, 1e-9);
}

TEST(QualityHistory, DoesNotRiseAndFallAgainWhereItGoesOneWay) {
  for (const auto& one_way : std::vector<std::function<double(double)>>{
           [](double) { return 10.0; }, [](double t) { return 10.0 + t / 100.0; },
           [](double t) { return 10.0 + 300.0 * std::exp(-t / 500.0); }}) {
    EXPECT_NEAR(*Sampled(one_way).history().swing_m(), 0.0, 1e-12);
  }
}

TEST(QualityHistory, OfTooFewLooksSaysNothing) {
  const Sampled none([](double) { return 1.0; }, -1.0);
  const QualityHistory empty(none.time_s, none.quality_m, 100.0);
  EXPECT_EQ(empty.mean_m(0.0), std::nullopt);
  EXPECT_EQ(empty.worst_m(0.0), std::nullopt);
  EXPECT_EQ(empty.trend_m_per_h(0.0), std::nullopt);
  EXPECT_EQ(empty.oscillation_m(), std::nullopt);
  EXPECT_EQ(empty.swing_m(), std::nullopt);
  const Sampled brief([](double) { return 1.0; }, 595.0);  // shorter than the window
  EXPECT_EQ(brief.history().oscillation_m(), std::nullopt);
  EXPECT_EQ(brief.history().swing_m(), std::nullopt);
  EXPECT_EQ(brief.history().trend_m_per_h(1.0), std::nullopt);  // one look
}

TEST(QualityHistory, IsThatOfVehiclesLostBeforeTheEndUpToThen) {
  const Sampled all([](double) { return 7.0; }, 1000.0);
  const QualityHistory lost(all.time_s, all.quality_m, mission_s);
  EXPECT_EQ(lost.mean_m(0.4), std::nullopt);
  EXPECT_EQ(lost.mean_m(0.1), 7.0);
  EXPECT_EQ(lost.oscillation_m(), std::nullopt);
}

}  // namespace
}  // namespace shoal::analysis
