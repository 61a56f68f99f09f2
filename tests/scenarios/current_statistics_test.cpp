#include "shoal/scenarios/currents/current_statistics.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>
#include <numbers>

#include "shoal/scenarios/currents/netcdf_statistics.hpp"
#include "shoal/scenarios/library_path.hpp"
#include "tests/support/reference_table.hpp"
#include "tests/support/shared_data.hpp"

namespace shoal::scenarios {
namespace {

using Eigen::Vector2d;
using Field = std::function<Vector2d(double x_m, double y_m, double time_s)>;

class Water final : public Current {
 public:
  explicit Water(Field field) : field_(std::move(field)) {}

  void sample(double time_s, std::span<const double> x_m, std::span<const double> y_m,
              std::span<double> u_m_s, std::span<double> v_m_s) const override {
    for (std::size_t i = 0; i < x_m.size(); ++i) {
      const Vector2d velocity = field_(x_m[i], y_m[i], time_s);
      u_m_s[i] = velocity.x();
      v_m_s[i] = velocity.y();
    }
  }

 private:
  Field field_;
};

using Statistics = std::map<std::string, std::optional<double>>;

Statistics by_name(const std::vector<CurrentStatistic>& statistics) {
  Statistics named;
  for (const CurrentStatistic& statistic : statistics) named[statistic.name] = statistic.value;
  return named;
}

Statistics statistics(const Field& field, const DriftingWindow& window = {}) {
  return by_name(current_statistics(Water(field), window));
}

constexpr double wave_m = 1400.0, wave_s = 5000.0;

/// Swirls that pulse, over a slow mean.
Vector2d swirling(double x_m, double y_m, double time_s) {
  const double k = 2.0 * std::numbers::pi / wave_m;
  const double pulse = 0.04 + 0.02 * std::sin(2.0 * std::numbers::pi * time_s / wave_s);
  return {0.01 + pulse * std::sin(k * y_m + 0.3) * std::cos(0.8 * k * x_m),
          -0.02 - pulse * std::cos(1.1 * k * x_m) * std::sin(0.6 * k * y_m + 1.0)};
}

void expect_same(const Statistics& a, const Statistics& b, double relative) {
  ASSERT_EQ(a.size(), b.size());
  for (const auto& [name, value] : a) {
    ASSERT_EQ(value.has_value(), b.at(name).has_value()) << name;
    if (!value) continue;
    EXPECT_NEAR(*value, *b.at(name), relative * std::abs(*value)) << name;
  }
}

TEST(CurrentStatistics, OfAUniformCurrentAreItsVelocity) {
  const Statistics s = statistics([](double, double, double) { return Vector2d(-0.06, 0.08); });
  EXPECT_NEAR(*s.at("mean_u_m_s"), -0.06, 1e-13);
  EXPECT_NEAR(*s.at("mean_v_m_s"), 0.08, 1e-13);
  EXPECT_NEAR(*s.at("drift_m"), 1800.0, 1e-8);
  EXPECT_NEAR(*s.at("variance_u_m2_s2") + *s.at("variance_v_m2_s2"), 0.0, 1e-28);
  EXPECT_NEAR(*s.at("shear_300m_m_s"), 0.0, 1e-15);
  EXPECT_FALSE(s.at("decorrelation_length_m"));
  EXPECT_FALSE(s.at("decorrelation_time_s"));
}

TEST(CurrentStatistics, OfALinearShearByHand) {
  constexpr double rate = 1e-4;
  const Statistics s = statistics([](double, double y, double) { return Vector2d(rate * y, 0.0); });
  EXPECT_NEAR(*s.at("drift_m"), 0.0, 1e-9);
  // 13 rows of 10 points: of 91 pairs along x and 100 along y only the latter differ.
  EXPECT_NEAR(*s.at("shear_300m_m_s"), 300.0 * rate * std::sqrt(100.0 / 191.0), 1e-12);
  EXPECT_NEAR(*s.at("variance_u_m2_s2"), 1e4 * rate * rate * (13 * 13 - 1) / 12.0, 1e-12);
  EXPECT_FALSE(s.at("decorrelation_time_s"));  // steady
}

TEST(CurrentStatistics, OfAnOscillationThatIsTheSameEverywhere) {
  const Statistics s = statistics([](double, double, double t) {
    return Vector2d(0.1, 0.05 * std::cos(2.0 * std::numbers::pi * t / 1500.0));
  });
  EXPECT_FALSE(s.at("decorrelation_length_m"));
  // Where a cosine is 1/e, up to the ends of the record and the straight line between two looks.
  const double expected = 1500.0 * std::acos(1.0 / std::numbers::e) / (2.0 * std::numbers::pi);
  EXPECT_NEAR(*s.at("decorrelation_time_s"), expected, 0.02 * expected);
}

TEST(CurrentStatistics, DoNotDependOnHowFastThePatternIsCarriedAlong) {
  const Statistics still = statistics(swirling);
  const Vector2d carried(0.3, -0.2);
  Statistics moving = statistics([&](double x, double y, double t) -> Vector2d {
    return swirling(x - carried.x() * t, y - carried.y() * t, t) + carried;
  });
  EXPECT_NEAR(*moving.at("mean_u_m_s"), *still.at("mean_u_m_s") + carried.x(), 1e-12);
  EXPECT_NEAR(*moving.at("mean_v_m_s"), *still.at("mean_v_m_s") + carried.y(), 1e-12);
  for (const char* of_the_way : {"mean_u_m_s", "mean_v_m_s", "drift_m"}) {
    moving[of_the_way] = still.at(of_the_way);
  }
  expect_same(still, moving, 1e-9);
}

TEST(CurrentStatistics, TurnWithTheWaterAndTheWindow) {
  const Statistics upright = statistics(swirling);
  // By a quarter turn: east becomes north.
  Statistics turned = statistics(
      [](double x, double y, double t) -> Vector2d {
        const Vector2d v = swirling(y, -x, t);
        return {-v.y(), v.x()};
      },
      {.width_m = 1200.0, .height_m = 900.0});
  EXPECT_NEAR(*turned.at("mean_v_m_s"), *upright.at("mean_u_m_s"), 1e-12);
  EXPECT_NEAR(*turned.at("mean_u_m_s"), -*upright.at("mean_v_m_s"), 1e-12);
  turned["mean_u_m_s"] = upright.at("mean_u_m_s");
  turned["mean_v_m_s"] = upright.at("mean_v_m_s");
  std::swap(turned["variance_u_m2_s2"], turned["variance_v_m2_s2"]);
  expect_same(upright, turned, 1e-9);
}

TEST(CurrentStatistics, RefuseAWindowThatItsStepsDoNotFill) {
  EXPECT_THROW(statistics(swirling, {.spacing_m = 70.0}), std::invalid_argument);
  EXPECT_THROW(statistics(swirling, {.duration_s = 250.0}), std::invalid_argument);
  EXPECT_THROW(statistics(swirling, {.step_s = 0.0}), std::invalid_argument);
}

// --- the current of the Red Sea --------------------------------------------------------------

void expect_reference(const std::filesystem::path& file, double relative) {
  const Statistics found = by_name(current_file_statistics(file));
  const tests::ReferenceTable reference("redsea_current_statistics.csv", {"statistic", "value"});
  ASSERT_EQ(reference.rows(), found.size());
  for (std::size_t row = 0; row < reference.rows(); ++row) {
    const std::string& name = reference.text(row, "statistic");
    ASSERT_TRUE(found.contains(name) && found.at(name)) << reference.line(row) << name;
    const double expected = reference.number(row, "value");
    EXPECT_NEAR(*found.at(name), expected, relative * std::abs(expected))
        << reference.line(row) << name;
  }
}

TEST(RedSeaLike, IsWithinATenthOfTheReconstructedCurrent) {
  expect_reference(library_path() / "currents/redsea_like.nc", 0.1);
}

TEST(RedSeaLike, ReferenceIsThatOfTheReconstructedCurrent) {
  const std::filesystem::path path = tests::shared_data("redsea_current.nc");
  SHOAL_NEEDS_SHARED(path);
  expect_reference(path, 1e-5);  // as many digits as the table has
}

}  // namespace
}  // namespace shoal::scenarios
