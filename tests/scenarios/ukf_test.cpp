#include "shoal/scenarios/estimators/ukf.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <numbers>

#include "shoal/core/random.hpp"
#include "tests/support/allocation_count.hpp"
#include "tests/support/nan_value.hpp"

namespace shoal::scenarios {
namespace {

using Eigen::Matrix2d;
using Eigen::Matrix4d;
using Eigen::Vector2d;
using Eigen::Vector4d;
using shoal::tests::nan_value;
using std::numbers::pi;

template <int N>
auto same() {
  return [](const Eigen::Matrix<double, N, 1>& x) { return x; };
}

/// Heading, speed, x, y; all are measured.
struct Car {
  double T = 0.5, turn = 0.1;
  Vector4d operator()(const Vector4d& x) const {
    return {x(0) + T * turn, x(1), x(2) + T * x(1) * std::cos(x(0)),
            x(3) + T * x(1) * std::sin(x(0))};
  }
};
const Vector4d car_noise(0.1, 0.1, 1.0, 1.0);
const Matrix4d car_start = Vector4d(0.04, 0.04, 1.0, 2.0).asDiagonal();

UkfSettings<4, 4> car_settings() {
  UkfSettings<4, 4> settings;
  settings.process_covariance = Vector4d(1e-4, 1e-3, 1e-4, 1e-4).asDiagonal();
  settings.measurement_covariance = car_noise.cwiseAbs2().asDiagonal();
  settings.state_is_angle = settings.measurement_is_angle = {true, false, false, false};
  return settings;
}

Vector4d noise(std::uint64_t k) {
  const auto [a, b] = RandomStreams(5).normal(Purpose::heading, 0, 2 * k);
  const auto [c, d] = RandomStreams(5).normal(Purpose::heading, 0, 2 * k + 1);
  return car_noise.cwiseProduct(Vector4d(a, b, c, d));
}

/// The filter after a drive, in a world that is turned by an angle, mirrored at its x axis, and
/// then moved.
Ukf<4, 4> driven(int steps, double turned = 0.0, double side = 1.0, double moved = 0.0) {
  const auto seen = [&](Vector4d x) {
    x(3) *= side;
    x.tail<2>() = Eigen::Rotation2Dd(turned) * x.tail<2>() + moved * Vector2d(1.0, -2.0);
    x(0) = side * x(0) + turned;
    return x;
  };
  Vector4d truth(0.4, 1.2, 3.0, -2.0);
  UkfSettings<4, 4> settings = car_settings();
  Ukf<4, 4> ukf(settings, seen(truth), Vector4d(0.04, 0.04, 1.0, 1.0).asDiagonal());
  for (int k = 0; k < steps; ++k) {
    truth = Car{}(truth);
    ukf.predict(Car{.turn = side * 0.1});
    ukf.correct(seen(truth + noise(static_cast<std::uint64_t>(k))), same<4>());
  }
  return ukf;
}

// Cholesky's root depends on the order of the states. Here those that the model is nonlinear in
// come first, so that the axes of x and y do not matter.
TEST(Ukf, TurnsWithTheWorld) {
  const Ukf<4, 4> here = driven(60);
  for (const double angle : {0.3, 2.0, -2.9, pi}) {
    const Ukf<4, 4> there = driven(60, angle);
    const Eigen::Rotation2Dd R(angle);
    EXPECT_LT((there.state().tail<2>() - R * here.state().tail<2>()).norm(), 1e-12) << angle;
    EXPECT_NEAR(wrapped(there.state()(0) - here.state()(0) - angle), 0.0, 1e-12) << angle;
    const Matrix2d turned = R.toRotationMatrix() * here.covariance().bottomRightCorner<2, 2>() *
                            R.inverse().toRotationMatrix();
    EXPECT_LT((there.covariance().bottomRightCorner<2, 2>() - turned).norm(), 1e-12) << angle;
  }
}

TEST(Ukf, IsMirroredAndMovedWithTheWorld) {
  const Ukf<4, 4> here = driven(60);
  const Ukf<4, 4> there = driven(60, 0.0, -1.0, 1000.0);
  const Vector4d mirror(-1.0, 1.0, 1.0, -1.0);
  const Vector4d expected = mirror.cwiseProduct(here.state()) + Vector4d(0.0, 0.0, 1000.0, -2000.0);
  EXPECT_LT((there.state() - expected).norm(), 1e-10);
  const Matrix4d P = mirror.asDiagonal() * here.covariance() * mirror.asDiagonal();
  EXPECT_LT((there.covariance() - P).norm(), 1e-11);
}

TEST(Ukf, DoesNotNoticeAHeadingThatComesRound) {
  // 400 steps of 0.05 rad are more than three full circles; every third measurement is 2 pi off.
  Vector4d truth(3.0, 1.0, 0, 0);
  Ukf<4, 4> ukf(car_settings(), truth, car_start);
  bool crossed = false;
  for (std::uint64_t k = 0; k < 400; ++k) {
    const double before = wrapped(truth(0));
    truth = Car{}(truth);
    crossed |= std::abs(wrapped(truth(0)) - before) > pi;
    EXPECT_EQ(ukf.predict(Car{}), UkfStatus::ok);
    Vector4d y = truth + noise(k);
    y(0) = wrapped(y(0)) + (k % 3 == 0 ? 2.0 * pi : 0.0);
    const auto& update = ukf.correct(y, same<4>());
    EXPECT_EQ(update.status, UkfStatus::ok);
    EXPECT_LE(std::abs(update.innovation(0)), pi);
    ASSERT_LT(std::abs(wrapped(ukf.state()(0) - truth(0))), 0.25) << k;
    ASSERT_LE(std::abs(ukf.state()(0)), pi);
  }
  EXPECT_TRUE(crossed);
}

TEST(Ukf, CovarianceStaysSymmetricAndPositiveDefinite) {
  const Ukf<4, 4> ukf = driven(500);
  EXPECT_EQ(ukf.covariance(), ukf.covariance().transpose().eval());
  EXPECT_GT(ukf.covariance().selfadjointView<Eigen::Lower>().eigenvalues()(0), 0.0);
  EXPECT_LT((ukf.root() * ukf.root().transpose() - ukf.covariance()).norm(), 1e-14);
}

TEST(Ukf, WithoutMeasurementsThePredictionStands) {
  Ukf<4, 4> ukf = driven(20);
  ukf.predict(Car{});
  const Vector4d x = ukf.state();
  const Matrix4d P = ukf.covariance();
  const auto& update = ukf.correct(Vector4d::Constant(nan_value), same<4>());
  EXPECT_EQ(ukf.state(), x);
  EXPECT_EQ(ukf.covariance(), P);
  EXPECT_EQ(update.used, 0);
  EXPECT_EQ(update.nis, 0.0);
  EXPECT_TRUE(update.missing.all());
}

TEST(Ukf, VarianceGrowsWhileAChannelIsAtFaultAndShrinksAfter) {
  Ukf<4, 4> ukf = driven(50);
  double before = ukf.covariance()(0, 0);
  for (int k = 0; k < 30; ++k) {
    ukf.predict(Car{});
    Vector4d y = ukf.state();
    y(0) = nan_value;
    ukf.correct(y, same<4>());
    EXPECT_GT(ukf.covariance()(0, 0), before);
    before = ukf.covariance()(0, 0);
  }
  ukf.predict(Car{});
  ukf.correct(ukf.state(), same<4>());
  EXPECT_LT(ukf.covariance()(0, 0), before);
}

TEST(Ukf, AFaultIsTheSameAsAFilterWithoutThatRow) {
  UkfSettings<2, 2> both;
  both.process_covariance = Matrix2d::Identity() * 0.1;
  both.measurement_covariance << 0.5, 0.2, 0.2, 0.4;
  UkfSettings<2, 1> first;
  first.process_covariance = both.process_covariance;
  first.measurement_covariance << 0.5;
  const Matrix2d P0 = (Matrix2d() << 1.0, 0.3, 0.3, 2.0).finished();
  Ukf<2, 2> deleted(both, Vector2d(1, 2), P0);
  Ukf<2, 1> without(first, Vector2d(1, 2), P0);
  deleted.correct(Vector2d(1.5, nan_value), same<2>());
  without.correct(Eigen::Matrix<double, 1, 1>(1.5),
                  [](const Vector2d& x) { return Eigen::Matrix<double, 1, 1>(x(0)); });
  EXPECT_LT((deleted.state() - without.state()).norm(), 1e-14);
  EXPECT_LT((deleted.covariance() - without.covariance()).norm(), 1e-14);
}

UkfSettings<2, 2> still() {
  UkfSettings<2, 2> settings;
  settings.process_covariance = Matrix2d::Identity() * 0.01;
  settings.measurement_covariance = Matrix2d::Identity();
  return settings;
}

TEST(Ukf, AValueBeyondFourSigmaOfItsInnovationIsAnOutlier) {
  // P_y = 3 + 1 = 2^2: the gate stands at 8.
  for (const double sign : {-1.0, 1.0}) {
    Ukf<2, 2> inside(still(), Vector2d(5, 0), Matrix2d::Identity() * 3.0);
    EXPECT_TRUE(inside.correct(Vector2d(5 + sign * 7.999, 0.5), same<2>()).rejected.none());
    Ukf<2, 2> outside(still(), Vector2d(5, 0), Matrix2d::Identity() * 3.0);
    const auto& update = outside.correct(Vector2d(5 + sign * 8.001, 0.5), same<2>());
    EXPECT_EQ(update.rejected.to_string(), "01");
    EXPECT_EQ(update.used, 1);
    EXPECT_EQ(outside.state()(0), 5.0);
    EXPECT_EQ(outside.covariance()(0, 0), 3.0);
    EXPECT_NEAR(outside.state()(1), 0.5 * 0.75, 1e-15);  // the other value counts as ever
  }
}

TEST(Ukf, DoubtsItselfAfterTenOutliersInARow) {
  Ukf<2, 2> ukf(still(), Vector2d::Zero(), Matrix2d::Identity());
  for (int k = 0; k < 10; ++k) {
    ukf.predict(same<2>());
    EXPECT_TRUE(ukf.correct(Vector2d(100, 0), same<2>()).rejected[0]) << k;
    EXPECT_EQ(ukf.state()(0), 0.0);
  }
  ukf.predict(same<2>());
  const auto& update = ukf.correct(Vector2d(100, 0), same<2>());
  EXPECT_TRUE(update.readmitted[0]);
  EXPECT_FALSE(update.rejected[0]);
  // P_y = (100 / 4)^2, of which 1 is R_n.
  EXPECT_NEAR(ukf.state()(0), 100.0 * 624.0 / 625.0, 1e-9);
  EXPECT_NEAR(ukf.covariance()(0, 0), 624.0 / 625.0, 1e-9);
  EXPECT_NEAR(ukf.state()(1), 0.0, 1e-12);
  ukf.predict(same<2>());
  EXPECT_TRUE(ukf.correct(Vector2d(100, 0), same<2>()).rejected.none());
}

TEST(Ukf, AGoodValueBetweenOutliersStartsTheCountAgain) {
  Ukf<2, 2> ukf(still(), Vector2d::Zero(), Matrix2d::Identity());
  for (int k = 0; k < 40; ++k) {
    ukf.predict(same<2>());
    const auto& update = ukf.correct(Vector2d(k % 10 == 9 ? 0.0 : 100.0, 0), same<2>());
    EXPECT_TRUE(update.readmitted.none()) << k;
  }
}

TEST(Ukf, FaultsBetweenOutliersDoNotStartTheCountAgain) {
  Ukf<2, 2> ukf(still(), Vector2d::Zero(), Matrix2d::Identity());
  int readmitted = 0;
  for (int k = 0; k < 21; ++k) {
    ukf.predict(same<2>());
    readmitted += ukf.correct(Vector2d(k % 2 == 0 ? 100.0 : nan_value, 0), same<2>()).readmitted[0];
  }
  EXPECT_EQ(readmitted, 1);
}

TEST(Ukf, RefusesWhatIsNoCovariance) {
  const auto says = [](const UkfSettings<2, 2>& settings, const Matrix2d& P, const char* words) {
    try {
      const Ukf<2, 2> ukf(settings, Vector2d::Zero(), P);
      ADD_FAILURE() << "took it: " << words;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
    }
  };
  const Matrix2d good = Matrix2d::Identity();
  const Matrix2d indefinite = (Matrix2d() << 1, 2, 2, 1).finished();
  const Matrix2d skew = (Matrix2d() << 1, 0.5, 0.4, 1).finished();
  UkfSettings<2, 2> settings = still();
  says(settings, indefinite,
       "initial covariance P_x(0) is not positive semidefinite: its smallest "
       "eigenvalue is -1");
  says(settings, skew, "not symmetric");
  says(settings, good * nan_value, "not finite");
  settings.process_covariance = indefinite;
  says(settings, good, "process covariance R_v is not positive semidefinite");
  settings = still();
  settings.measurement_covariance = -good;
  says(settings, good, "measurement covariance R_n is not positive semidefinite");
  settings = still();
  settings.scaling.kappa = -2.0;
  says(settings, good, "kappa");
}

TEST(Ukf, TakesAStartThatIsKnownExactly) {
  Ukf<2, 2> ukf(still(), Vector2d(3, 4), Matrix2d::Zero());
  EXPECT_EQ(ukf.predict(same<2>()), UkfStatus::ok);
  EXPECT_LT((ukf.covariance() - still().process_covariance).norm(), 1e-16);
}

TEST(Ukf, ANegativeCentralWeightCanMakeACovarianceIndefiniteWhichIsRepairedAndSaid) {
  UkfSettings<2, 2> settings = still();
  settings.scaling = {1.0, 0.0, -1.0};
  settings.process_covariance.setZero();
  Ukf<2, 2> ukf(settings, Vector2d::Zero(), Matrix2d::Identity());
  // The points are at distance 1 with weights 1/2, w_m of the centre is -1, w_c too: the mean of
  // |x|^2 is 2, and its variance comes out as -4 + 4 (1/2) = -2.
  const UkfStatus status =
      ukf.predict([](const Vector2d& x) { return Vector2d(x.squaredNorm(), x(1)); });
  EXPECT_EQ(status, UkfStatus::repaired);
  EXPECT_GT(ukf.covariance().selfadjointView<Eigen::Lower>().eigenvalues()(0), 0.0);
  EXPECT_TRUE(ukf.state().allFinite());
}

TEST(Ukf, IsLostWhereAModelIsNotFiniteAndKeepsWhatItHad) {
  Ukf<2, 2> ukf(still(), Vector2d(1, 2), Matrix2d::Identity());
  EXPECT_EQ(ukf.predict([](const Vector2d& x) { return Vector2d(std::log(x(0)), x(1)); }),
            UkfStatus::lost);
  EXPECT_EQ(ukf.state(), Vector2d(1, 2));
  EXPECT_EQ(ukf.covariance(), Matrix2d::Identity());
  const auto& update =
      ukf.correct(Vector2d(1, 2), [](const Vector2d& x) { return Vector2d(1.0 / 0.0, x(1)); });
  EXPECT_EQ(update.status, UkfStatus::lost);
  EXPECT_EQ(ukf.state(), Vector2d(1, 2));
  ukf.restart(Vector2d(7, 8), Matrix2d::Identity());
  EXPECT_EQ(ukf.predict(same<2>()), UkfStatus::ok);
}

TEST(Ukf, SaysThatAnInnovationCovarianceHasNoInverse) {
  UkfSettings<2, 2> settings = still();
  settings.measurement_covariance.setZero();
  Ukf<2, 2> ukf(settings, Vector2d(1, 2), Matrix2d::Zero());
  const auto& update = ukf.correct(Vector2d(1, 2), same<2>());
  EXPECT_EQ(update.status, UkfStatus::singular);
  EXPECT_EQ(update.used, 0);
  EXPECT_EQ(ukf.state(), Vector2d(1, 2));
}

TEST(Ukf, AnAngleThatIsNotMeasuredBecomesUnknownButNotWrong) {
  UkfSettings<4, 4> settings = car_settings();
  settings.process_covariance(0, 0) = 0.05;
  Ukf<4, 4> ukf(settings, Vector4d(3.1, 1, 0, 0), car_start);
  UkfStatus worst = UkfStatus::ok;
  for (int k = 0; k < 100; ++k) worst = std::max(worst, ukf.predict(Car{}));
  EXPECT_EQ(worst, UkfStatus::saturated);
  // The points, 2 sigma away, stay on their own side of the circle.
  EXPECT_LT(2.0 * std::sqrt(ukf.covariance()(0, 0)), pi);
  EXPECT_GT(2.0 * std::sqrt(ukf.covariance()(0, 0)), 0.6 * pi);
  Vector4d y = ukf.state();
  y(0) = wrapped(y(0) + 2.5);
  ukf.correct(y, same<4>());
  EXPECT_LT(std::abs(wrapped(ukf.state()(0) - y(0))), 0.1);
}

TEST(Ukf, AllocatesNothing) {
  Ukf<4, 4> ukf = driven(3);
  Vector4d y = ukf.state();
  y(1) = nan_value;
  const std::size_t before = tests::heap_requests();
  for (int k = 0; k < 100; ++k) {
    ukf.predict(Car{});
    y(2) = k % 30 < 15 ? 100.0 : 0.0;  // outliers, too
    ukf.correct(y, same<4>());
  }
  EXPECT_EQ(tests::heap_requests() - before, 0u);
#ifndef SHOAL_SANITIZED
  const Eigen::MatrixXd counted(3, 3);
  EXPECT_GT(tests::heap_requests() - before, 0u) << counted.rows();
#endif
}

TEST(LowerRoot, TakesSemidefiniteMatricesAndNoOthers) {
  Matrix4d A = Matrix4d::Zero();
  A.col(0) = Vector4d(1, -2, 0.5, 3);
  A.col(2) = Vector4d(0, 1, 4, -1);
  const Matrix4d P = A * A.transpose();  // of rank two
  Matrix4d S;
  ASSERT_TRUE(lower_root<4>(P, S));
  EXPECT_LT((S * S.transpose() - P).norm(), 1e-13 * P.norm());
  Matrix4d Q = P;
  Q(2, 2) -= 1e-6;
  EXPECT_FALSE(lower_root<4>(Q, S));
  Q = P;
  Q(3, 1) += 0.1;
  EXPECT_FALSE(lower_root<4>(Q, S));
}

}  // namespace
}  // namespace shoal::scenarios
