// Agreement with tests/data/ukf.csv, made by an independent implementation.

#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <sstream>
#include <vector>

#include "shoal/scenarios/estimators/ukf.hpp"

namespace shoal::scenarios {
namespace {

/// case -> quantity -> (row, column) -> value
using Table = std::map<std::string, std::map<std::string, std::map<std::pair<int, int>, double>>>;

const Table& reference() {
  static const Table table = [] {
    Table read;
    std::ifstream file(SHOAL_SOURCE_DIR "/tests/data/ukf.csv");
    std::string line;
    std::getline(file, line);
    while (std::getline(file, line)) {
      std::istringstream fields(line);
      std::string name, quantity, row, column, value;
      std::getline(fields, name, ',');
      std::getline(fields, quantity, ',');
      std::getline(fields, row, ',');
      std::getline(fields, column, ',');
      std::getline(fields, value);
      read[name][quantity][{std::stoi(row), std::stoi(column)}] = std::stod(value);
    }
    return read;
  }();
  return table;
}

template <int Rows, int Columns>
Eigen::Matrix<double, Rows, Columns> matrix(const std::string& name, const std::string& quantity) {
  const auto& entries = reference().at(name).at(quantity);
  Eigen::Matrix<double, Rows, Columns> m;
  EXPECT_EQ(entries.size(), static_cast<std::size_t>(Rows * Columns)) << name << ' ' << quantity;
  m.setConstant(std::numeric_limits<double>::infinity());
  for (int i = 0; i < Rows; ++i) {
    for (int j = 0; j < Columns; ++j) m(i, j) = entries.at({i, j});
  }
  return m;
}

UkfScaling scaling(const std::string& name) {
  const auto abk = matrix<1, 3>(name, "abk");
  return {abk(0), abk(1), abk(2)};
}

/// Largest difference; a NaN on one side only counts as infinite.
template <class A, class B>
double difference(const A& a, const B& b) {
  double largest = 0.0;
  for (int i = 0; i < a.rows(); ++i) {
    for (int j = 0; j < a.cols(); ++j) {
      if (std::isnan(a(i, j)) && std::isnan(b(i, j))) continue;
      const double d = std::abs(a(i, j) - b(i, j));
      largest = std::max(largest, std::isnan(d) ? HUGE_VAL : d);
    }
  }
  return largest;
}

TEST(UkfReference, WeightsAgree) {
  int cases = 0;
  for (const auto& each : reference()) {
    const auto& name = each.first;
    const auto& quantities = each.second;
    if (name.rfind("W_", 0) != 0) continue;
    ++cases;
    const auto value = [&](const char* quantity) { return quantities.at(quantity).at({0, 0}); };
    const int n = static_cast<int>(value("L"));
    const SigmaWeights w = sigma_weights(n, {value("alpha"), value("beta"), value("kappa")});
    const auto agrees = [&](double ours, const char* quantity) {
      EXPECT_NEAR(ours / value(quantity), 1.0, 1e-9) << name << ' ' << quantity;
    };
    agrees(w.gamma, "gamma");
    if (value("wm0") == 0.0) {
      EXPECT_NEAR(w.mean_centre, 0.0, 1e-15) << name;
    } else {
      agrees(w.mean_centre, "wm0");
    }
    agrees(w.covariance_centre, "wc0");
    agrees(w.other, "wi");
    agrees(w.mean_centre + 2 * n * w.other, "sum_wm");
    agrees(w.covariance_centre + 2 * n * w.other, "sum_wc");
  }
  EXPECT_GE(cases, 5);
}

/// The model of case C1 (four states, three measurements).
struct CarAndBeacon {
  Eigen::Vector4d operator()(const Eigen::Vector4d& x) const {
    constexpr double T = 0.5;
    const double v = x(2), psi = x(3);
    return {x(0) + T * v * std::cos(psi), x(1) + T * v * std::sin(psi),
            v + T * (0.1 - 0.05 * v * std::abs(v)), psi + T * 0.08 * v};
  }
  static Eigen::Vector3d measure(const Eigen::Vector4d& x) {
    const double dx = x(0) - 20.0, dy = x(1) + 5.0;
    return {std::hypot(dx, dy), std::atan2(dy, dx), x(2)};
  }
};

UkfSettings<4, 3> car_and_beacon_settings() {
  UkfSettings<4, 3> settings;
  settings.scaling = scaling("C1");
  settings.process_covariance = matrix<4, 4>("C1", "Rv");
  settings.measurement_covariance = matrix<3, 3>("C1", "Rn");
  settings.gate.sigma = 0.0;
  return settings;
}

void follows_the_car(const UkfSettings<4, 3>& settings) {
  Ukf<4, 3> ukf(settings, matrix<4, 1>("C1", "x0"), matrix<4, 4>("C1", "P0"));
  for (int step = 1; step <= 6; ++step) {
    const std::string name = "C1_step" + std::to_string(step);
    EXPECT_EQ(ukf.predict(CarAndBeacon{}), UkfStatus::ok);
    EXPECT_LT(difference(ukf.state(), matrix<4, 1>(name, "x_pred")), 1e-9) << name;
    EXPECT_LT(difference(ukf.covariance(), matrix<4, 4>(name, "P_pred")), 1e-9) << name;
    const auto& update = ukf.correct(matrix<3, 1>(name, "y"), CarAndBeacon::measure);
    EXPECT_EQ(update.status, UkfStatus::ok);
    EXPECT_LT(difference(ukf.state(), matrix<4, 1>(name, "x_post")), 1e-9) << name;
    EXPECT_LT(difference(ukf.covariance(), matrix<4, 4>(name, "P_post")), 1e-9) << name;
  }
}

TEST(UkfReference, FollowsTheNonlinearCaseThroughMissingMeasurements) {
  follows_the_car(car_and_beacon_settings());
}

TEST(UkfReference, DeclaringAnglesChangesNothingWhileNoneComesRound) {
  UkfSettings<4, 3> settings = car_and_beacon_settings();
  settings.state_is_angle = {false, false, false, true};
  settings.measurement_is_angle = {false, true, false};
  follows_the_car(settings);
}

TEST(UkfReference, EveryIntermediateQuantityOfTheFirstStepAgrees) {
  Ukf<4, 3> ukf(car_and_beacon_settings(), matrix<4, 1>("C1", "x0"), matrix<4, 4>("C1", "P0"));
  Eigen::Matrix<double, 4, 9> sigma, propagated, redrawn;
  Eigen::Matrix<double, 3, 9> measured;
  int k = 0;
  ukf.predict([&](const Eigen::Vector4d& x) {
    sigma.col(k) = x;
    propagated.col(k) = CarAndBeacon{}(x);
    return Eigen::Vector4d(propagated.col(k++));
  });
  k = 0;
  const auto& update = ukf.correct(matrix<3, 1>("C1_step1", "y"), [&](const Eigen::Vector4d& x) {
    redrawn.col(k) = x;
    measured.col(k) = CarAndBeacon::measure(x);
    return Eigen::Vector3d(measured.col(k++));
  });
  EXPECT_LT(difference(sigma, matrix<4, 9>("C1_step1", "sigma")), 1e-9);
  EXPECT_LT(difference(propagated, matrix<4, 9>("C1_step1", "sigma_prop")), 1e-9);
  EXPECT_LT(difference(redrawn, matrix<4, 9>("C1_step1", "sigma_redraw")), 1e-9);
  EXPECT_LT(difference(measured, matrix<3, 9>("C1_step1", "Y")), 1e-9);
  EXPECT_LT(difference(update.innovation, matrix<3, 1>("C1_step1", "innov")), 1e-9);
  EXPECT_LT(difference(update.innovation_covariance, matrix<3, 3>("C1_step1", "P_y")), 1e-9);
  EXPECT_LT(difference(update.gain, matrix<4, 3>("C1_step1", "K")), 1e-9);
  EXPECT_LT(
      difference(update.gain * update.innovation_covariance, matrix<4, 3>("C1_step1", "P_xy")),
      1e-9);
}

void is_the_kalman_filter(const UkfScaling& chosen, double tolerance) {
  const auto F = matrix<2, 2>("C2", "F");
  const auto H = matrix<1, 2>("C2", "H");
  UkfSettings<2, 1> settings;
  settings.scaling = chosen;
  settings.process_covariance = matrix<2, 2>("C2", "Rv");
  settings.measurement_covariance = matrix<1, 1>("C2", "Rn");
  settings.gate.sigma = 0.0;
  Ukf<2, 1> ukf(settings, matrix<2, 1>("C2", "x0"), matrix<2, 2>("C2", "P0"));
  for (int step = 1; step <= 3; ++step) {
    const std::string name = "C2_step" + std::to_string(step);
    ukf.predict([&](const Eigen::Vector2d& x) -> Eigen::Vector2d { return F * x; });
    ukf.correct(matrix<1, 1>(name, "y"),
                [&](const Eigen::Vector2d& x) -> Eigen::Matrix<double, 1, 1> { return H * x; });
    EXPECT_LT(difference(ukf.state(), matrix<2, 1>(name, "x_post_exactKF")), tolerance) << name;
    EXPECT_LT(difference(ukf.covariance(), matrix<2, 2>(name, "P_post_exactKF")), tolerance)
        << name;
  }
}

TEST(UkfReference, IsTheExactKalmanFilterWhereEverythingIsLinear) {
  is_the_kalman_filter({1.0, 2.0, 0.0}, 1e-14);
  is_the_kalman_filter({1.0, 0.0, 1.0}, 1e-14);
  is_the_kalman_filter({0.5, 2.0, 0.0}, 1e-13);
}

TEST(UkfReference, ASmallAlphaMultipliesTheRoundingOfTheModelByItsWeights) {
  // The model's values, about 1, are rounded before the filter sees them. Four of them enter a mean
  // with weights of 1 / (4 alpha^2), and means enter three steps, twice each.
  const UkfScaling chosen = scaling("C2");
  const double rounding = 0.5 * std::numeric_limits<double>::epsilon();
  is_the_kalman_filter(chosen, 3 * 2 * 4 * sigma_weights(2, chosen).other * rounding);
}

}  // namespace
}  // namespace shoal::scenarios
