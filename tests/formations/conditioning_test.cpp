#include "shoal/formations/conditioning.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "shoal/core/error.hpp"
#include "tests/support/reference_table.hpp"

namespace shoal::formations {
namespace {

using Eigen::Vector2d;

constexpr double usual_period_s = 0.5;
const PerformanceEnvelope usual;

struct Case {
  Vector2d force;
  Motion motion;
  double period_s;
  PerformanceEnvelope envelope;
};

/// Forces up to sixty times the envelope, any motion within it, and envelopes of all proportions.
class Cases {
 public:
  Case next() {
    PerformanceEnvelope envelope{.speed_max_m_s = number(0.5, 3),
                                 .speed_min_m_s = flip() ? 0.0 : number(0, 0.4),
                                 .acceleration_max_m_s2 = number(0.01, 0.5),
                                 .turn_rate_max_rad_s = number(0.01, 0.5),
                                 .turn_acceleration_max_rad_s2 = number(0.01, 0.5)};
    const Motion motion{number(envelope.speed_min_m_s, envelope.speed_max_m_s),
                        number(-1, 1) * envelope.turn_rate_max_rad_s};
    const double size = std::pow(10.0, number(-3, 1.5)) * envelope.acceleration_max_m_s2;
    return {{size * number(-1, 1), size * number(-1, 1)}, motion, number(0.1, 2), envelope};
  }

 private:
  double number(double low, double high) {
    return low + (high - low) * static_cast<double>(random_()) / 4294967295.0;
  }
  bool flip() { return random_() % 2 == 0; }

  std::mt19937 random_{7};
};

TEST(ConditioningReference, AgreesWithAnotherImplementation) {
  const shoal::tests::ReferenceTable table(
      "force_clamp.csv", {"f_par", "f_perp", "u_prev", "r_prev", "T", "u_max", "du_max", "r_max",
                          "dr_max", "u_cmd", "dpsi_cmd", "f_par_out", "f_perp_out"});
  ASSERT_EQ(table.rows(), 100u);
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const auto number = [&](const char* column) { return table.number(row, column); };
    const PerformanceEnvelope envelope{.speed_max_m_s = number("u_max"),
                                       .acceleration_max_m_s2 = number("du_max"),
                                       .turn_rate_max_rad_s = number("r_max"),
                                       .turn_acceleration_max_rad_s2 = number("dr_max")};
    const auto command = conditioned({number("f_par"), number("f_perp")},
                                     {number("u_prev"), number("r_prev")}, number("T"), envelope);
    EXPECT_NEAR(command.speed_m_s, number("u_cmd"), 1e-9) << table.line(row);
    EXPECT_NEAR(command.turn_rad, number("dpsi_cmd"), 1e-9) << table.line(row);
    EXPECT_NEAR(command.force.x(), number("f_par_out"), 1e-9) << table.line(row);
    EXPECT_NEAR(command.force.y(), number("f_perp_out"), 1e-9) << table.line(row);
  }
}

TEST(Conditioning, NeverLeavesTheEnvelope) {
  Cases cases;
  for (int i = 0; i < 20'000; ++i) {
    const auto [force, motion, period_s, envelope] = cases.next();
    const ConditionedCommand command = conditioned(force, motion, period_s, envelope);
    ASSERT_TRUE(command.reachable);
    const double slack = 1e-12;
    ASSERT_LE(command.speed_m_s, envelope.speed_max_m_s + slack) << i;
    ASSERT_GE(command.speed_m_s, envelope.speed_min_m_s - slack) << i;
    ASSERT_LE(std::abs(command.acceleration_m_s2), envelope.acceleration_max_m_s2 + slack) << i;
    ASSERT_LE(std::abs(command.turn_rate_rad_s), envelope.turn_rate_max_rad_s + slack) << i;
    const double turning =
        std::abs(command.turn_rate_rad_s - motion.turn_rate_rad_s) / period_s;  // eq. 84
    ASSERT_LE(turning, envelope.turn_acceleration_max_rad_s2 + slack / period_s) << i;
  }
}

TEST(Conditioning, TellsOfTheSameCommandInAllItsForms) {
  Cases cases;
  for (int i = 0; i < 2'000; ++i) {
    const auto [force, motion, period_s, envelope] = cases.next();
    const ConditionedCommand command = conditioned(force, motion, period_s, envelope);
    // Eq. 81-83 of the force that is handed on.
    const Vector2d velocity = period_s * command.force + Vector2d(motion.speed_m_s, 0.0);
    EXPECT_NEAR(velocity.norm(), command.speed_m_s, 1e-12);
    if (command.speed_m_s > 1e-6) {
      EXPECT_NEAR(std::atan2(velocity.y(), velocity.x()), command.turn_rad, 1e-9);
    }
    EXPECT_DOUBLE_EQ(command.turn_rate_rad_s, command.turn_rad / period_s);
    EXPECT_NEAR(motion.speed_m_s + period_s * command.acceleration_m_s2, command.speed_m_s, 1e-12);
  }
}

TEST(Conditioning, LeavesAloneWhatIsAdmissible) {
  Cases cases;
  int tried = 0;
  for (int i = 0; i < 20'000; ++i) {
    const auto [force, motion, period_s, envelope] = cases.next();
    const ConditionedCommand once = conditioned(force, motion, period_s, envelope);
    // Wider turns than a right angle have no force that asks for them: eq. 83 turns less.
    if (std::abs(once.turn_rad) > 0.49 * std::numbers::pi) continue;
    // The inner arc is admissible, but what rounds to below it is braked to its foremost point.
    const AdmissibleSet set(envelope, motion, period_s);
    const double size = once.speed_m_s / period_s;
    if (once.turn_rad != 0.0 && size < set.size_min_m_s2 + 1e-12) continue;
    ++tried;
    const ConditionedCommand twice = conditioned(once.force, motion, period_s, envelope);
    // On the outer arc, the root of a difference of equal squares costs half the digits.
    const double tolerance = 1e-7 * envelope.speed_max_m_s / period_s;
    ASSERT_LT((twice.force - once.force).norm(), tolerance) << i;
  }
  EXPECT_GT(tried, 10'000);
}

TEST(Conditioning, DoesTheMirrorImageForTheMirroredInput) {
  Cases cases;
  for (int i = 0; i < 2'000; ++i) {
    const auto [force, motion, period_s, envelope] = cases.next();
    const ConditionedCommand one = conditioned(force, motion, period_s, envelope);
    const ConditionedCommand other = conditioned(
        {force.x(), -force.y()}, {motion.speed_m_s, -motion.turn_rate_rad_s}, period_s, envelope);
    if (force.y() == 0.0) continue;
    EXPECT_EQ(one.speed_m_s, other.speed_m_s);
    EXPECT_EQ(one.turn_rad, -other.turn_rad);
  }
}

// 1 m/s and 0.5 s: the velocity over the period is 2 m/s2 ahead, and may become 1.95 to 2.05.
TEST(Conditioning, AcceleratesAsFastAsItMayStraightAhead) {
  const auto command = conditioned({3, 0}, {1, 0}, usual_period_s, usual);
  EXPECT_NEAR(command.speed_m_s, 1.025, 1e-15);
  EXPECT_EQ(command.turn_rad, 0.0);
  EXPECT_NEAR(command.force.x(), 0.05, 1e-15);
}

TEST(Conditioning, BrakesNoFasterThanItMayAndNeverGoesAstern) {
  EXPECT_NEAR(conditioned({-3, 0}, {1, 0}, usual_period_s, usual).speed_m_s, 0.975, 1e-15);
  const auto stopping = conditioned({-3, 0}, {0.01, 0}, usual_period_s, usual);
  EXPECT_EQ(stopping.speed_m_s, 0.0);
  EXPECT_NEAR(stopping.force.x(), -0.02, 1e-15);
}

TEST(Conditioning, ClosesTheEnvelopeOnOneSideWhileTheVehicleTurns) {
  // T r +- T^2 r' = 0.03 +- 0.01, and T r_max = 0.04: C57, C59.
  const AdmissibleSet set(usual, {1, 0.06}, usual_period_s);
  EXPECT_NEAR(set.turn_min_rad, 0.02, 1e-15);
  EXPECT_NEAR(set.turn_max_rad, 0.04, 1e-15);
  EXPECT_NEAR(set.size_min_m_s2, 1.95, 1e-15);
  EXPECT_NEAR(set.size_max_m_s2, 2.05, 1e-15);
  EXPECT_TRUE(set.reachable);
}

TEST(Conditioning, ProjectsOntoTheLimitingRayIfItAcceleratesElseKeepsTheSpeedAlongTheHeading) {
  // s = (2.02, 0.2): rho = 2.0299, delta = 0.0987; the turn is limited to 0.01 from rest.
  const double turn = 0.01;
  const auto fast = conditioned({0.02, 0.2}, {1, 0}, usual_period_s, usual);
  EXPECT_NEAR(fast.turn_rad, turn, 1e-15);
  EXPECT_NEAR(fast.force.x() + 2.0, (2.02 * std::cos(turn) + 0.2 * std::sin(turn)) * std::cos(turn),
              1e-14);
  const auto slow = conditioned({-0.02, 0.2}, {1, 0}, usual_period_s, usual);
  EXPECT_NEAR(slow.turn_rad, turn, 1e-15);
  EXPECT_NEAR(slow.force.x(), -0.02, 1e-15);
  EXPECT_NEAR(slow.force.y(), 1.98 * std::tan(turn), 1e-15);
}

TEST(Conditioning, SaysSoIfNoCommandReachesTheEnvelope) {
  for (const Motion& motion : {Motion{2.1, 0}, Motion{-0.1, 0}, Motion{1, 0.2}, Motion{1, -0.2}}) {
    const auto command = conditioned({0.01, 0.01}, motion, usual_period_s, usual);
    EXPECT_FALSE(command.reachable);
    EXPECT_LE(command.speed_m_s, 2.0 + 1e-15);
    EXPECT_GE(command.speed_m_s, 0.0);
    EXPECT_LE(std::abs(command.turn_rate_rad_s), 0.08 + 1e-15);
  }
  EXPECT_EQ(conditioned({0, 0}, {1, 0.2}, usual_period_s, usual).turn_rad,
            -conditioned({0, 0}, {1, -0.2}, usual_period_s, usual).turn_rad);
  // Just within reach.
  EXPECT_TRUE(conditioned({0, 0}, {2.024, 0.09}, usual_period_s, usual).reachable);
}

TEST(PerformanceEnvelope, RefusesASpeedThatIsLeastAboveTheGreatest) {
  Setting table;
  assign(table, "speed_min_m_s", Setting{2.5, {}});
  PerformanceEnvelope envelope;
  EXPECT_THROW(read(envelope, table, "envelope"), InputError);
}

}  // namespace
}  // namespace shoal::formations
