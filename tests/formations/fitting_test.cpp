// What holds for the behaviours that fit the plan to what was heard, with every loss and weighting.

#include "shoal/formations/fitting.hpp"

#include <gtest/gtest.h>

#include <array>
#include <thread>
#include <tuple>

#include "shoal/core/text.hpp"
#include "shoal/solvers/registration/registration.hpp"
#include "shoal/solvers/solver.hpp"
#include "tests/formations/swarm.hpp"

namespace shoal::formations {
namespace {

using namespace tests;
using solvers::Loss;
using solvers::Solver;

std::unique_ptr<Behaviour> fitting(const std::string& kind, const std::string& loss,
                                   const std::string& weighting, double rangeout_m = 1e4) {
  if (kind == pairwise_kind) {
    return behaviour(
        kind, {{"contact_rangeout_m", rangeout_m}, {"loss.kind", loss}, {"weighting", weighting}});
  }
  const std::string registration = loss == "least_squares" ? "procrustes" : "newton";
  return behaviour(kind, {{"contact_rangeout_m", rangeout_m},
                          {"loss.kind", loss},
                          {"weighting", weighting},
                          {"registration.kind", registration}});
}

class Fitting : public testing::TestWithParam<std::tuple<std::string, std::string, std::string>> {
 protected:
  const std::string kind = std::get<0>(GetParam());
  const std::string loss = std::get<1>(GetParam());
  const std::string weighting = std::get<2>(GetParam());
  const std::unique_ptr<Behaviour> made = fitting(kind, loss, weighting);
  const bool closed_form = loss == "least_squares";
};

TEST_P(Fitting, StaysWhereTheFormationIsAsPlannedWhateverItsPose) {
  EXPECT_TRUE(rc::check("placed as planned: zero displacement", [&] {
    const Plan plan = drawn_plan(3, 12);
    const int own = drawn_int(0, plan.size() - 1);
    const Neighbours seen = heard(plan, own, drawn_motion());
    const Target target = made->step({seen, own}, plan);
    RC_ASSERT(target.reason == Reason::placed);
    RC_ASSERT(target.position.norm() < (closed_form ? 1e-8 : 1e-6));
  }));
}

TEST_P(Fitting, TurnsWithTheNeighboursAndIgnoresPoseNumbersAndOrder) {
  const double tolerance_m = closed_form ? 1e-7 : 1e-2;
  EXPECT_TRUE(rc::check("rotation, plan frame, labels, order", [&] {
    const Plan plan = drawn_plan(3, 16);
    const int own = drawn_int(0, plan.size() - 1);
    const Neighbours seen = drawn_neighbours(plan, own);
    const Vector2d target = made->step({seen, own}, plan).position;

    const Transform2 turn = rotation(drawn_angle());
    const Vector2d by_turned = made->step({turned(seen, turn), own}, plan).position;
    RC_ASSERT((by_turned - turn.rotate(target)).norm() < tolerance_m);

    const Vector2d by_moved = made->step({seen, own}, moved(plan, drawn_motion())).position;
    RC_ASSERT((by_moved - target).norm() < tolerance_m);

    const std::vector<int> order = drawn_order(plan.size());
    Neighbours relabelled = shuffled(seen);
    for (Neighbour& n : relabelled) n.slot = order[static_cast<std::size_t>(n.slot)];
    const int own_anew = order[static_cast<std::size_t>(own)];
    const Vector2d by_labels = made->step({relabelled, own_anew}, renumbered(plan, order)).position;
    RC_ASSERT((by_labels - target).norm() < tolerance_m);
  }));
}

TEST_P(Fitting, LetsOneNeighbourThatIsFarFromItsPlacePullOnlyWithLeastSquares) {
  const Plan plan = square_lattice(3, 3, 200.0);
  Neighbours seen = heard(plan, 4, rotation(0.4));  // the vehicle is in its place
  seen[1].position += Vector2d(350, 350);
  const Target target = made->step({seen, 4}, plan);
  EXPECT_EQ(target.reason, Reason::placed);
  const double moved_m = target.position.norm();
  if (closed_form) {
    EXPECT_GT(moved_m, 30.0);
  } else {
    EXPECT_LT(moved_m, loss == "tukey" ? 0.1 : 10.0);
  }
}

TEST_P(Fitting, AnswersDegenerateSwarmsWithAFiniteTarget) {
  const Plan plan = square_lattice(4, 3, 300.0);
  const auto near = fitting(kind, loss, weighting, 650.0);
  for (const Points& positions : std::vector<Points>{{},
                                                     {{200, 0}},
                                                     {{0, 0}},
                                                     {{0, 0}, {0, 0}},
                                                     {{100, 0}, {-100, 0}},
                                                     {{100, 100}, {200, 200}, {300, 300}},
                                                     {{50, 0}, {50, 0}, {50, 0}},
                                                     {{1e-12, 0}, {0, 1e-12}},
                                                     {{1e-300, 0}, {-1e-300, 1e-300}},
                                                     {{650, 0}, {0, 650}, {-650, 0}},
                                                     {{1e7, 0}, {0, -1e7}}}) {
    Neighbours seen;
    for (const Vector2d& p : positions) seen.push_back({p, 0.0, static_cast<int>(seen.size()) + 1});
    for (const auto* one : {made.get(), near.get()}) {
      const Target target = one->step({seen, 0}, plan);
      EXPECT_TRUE(target.position.allFinite() && std::isfinite(target.cost)) << seen.size();
      if (target.held()) {
        EXPECT_EQ(target.position, Vector2d(0, 0));
      }
    }
  }
}

TEST_P(Fitting, GivesTwoThreadsTheSameBits) {
  const Plan plan = square_lattice(4, 3, 300.0);
  const auto fly = [&](std::vector<Target>& targets) {
    for (int own = 0; own < plan.size(); ++own) {
      Neighbours seen = heard(plan, own, rotation(0.3 * own), {11.0 + own, -7.0 * own});
      seen[3].position += Vector2d(200, 0);
      targets.push_back(made->step({seen, own}, plan));
    }
  };
  std::array<std::vector<Target>, 2> targets;
  {
    std::jthread other(fly, std::ref(targets[1]));
    fly(targets[0]);
  }
  for (std::size_t i = 0; i < targets[0].size(); ++i) {
    EXPECT_EQ(targets[0][i].position, targets[1][i].position);
    EXPECT_EQ(targets[0][i].cost, targets[1][i].cost);
  }
}

INSTANTIATE_TEST_SUITE_P(Behaviours, Fitting,
                         testing::Combine(testing::Values(rigid_kind, pairwise_kind),
                                          testing::ValuesIn(Registry<Loss>::instance().names()),
                                          testing::Values("none", "distance", "ping_age")),
                         [](const auto& tested) {
                           return std::get<0>(tested.param) + "_" + std::get<1>(tested.param) +
                                  "_" + std::get<2>(tested.param);
                         });

TEST(PairwiseReferencing, GoesWhereTheSumOfLossesIsLeast) {
  const Plan line = plan_of({{0, 0}, {100, 0}, {200, 0}, {400, 0}});
  const Neighbours seen{{{110, 0}, 0.0, 1}, {{230, 0}, 0.0, 2}, {{370, 0}, 0.0, 3}};
  const auto huber = behaviour(pairwise_kind, {{"weighting", "none"},
                                               {"loss.kind", "huber"},
                                               {"loss.huber.scale_m", 5.0},
                                               {"solver.newton.x_tolerance_m", 1e-8}});
  // The places are 20, -10 and 0 m; two are beyond the scale and pull alike, one east, one west.
  const Target target = huber->step({seen, 0}, line);
  EXPECT_NEAR(target.position.x(), 0.0, 1e-7);
  EXPECT_NEAR(target.position.y(), 0.0, 1e-7);
  EXPECT_NEAR(target.cost, (2 * 5 * 20 - 25) + (2 * 5 * 10 - 25), 1e-9);
}

TEST(PairwiseReferencing, IsSolvedByEverySolverOrRefusedWithItsReason) {
  const Plan plan = square_lattice(3, 3, 200.0);
  Neighbours seen = heard(plan, 4, rotation(0.4), {30, -40});
  seen[1].position += Vector2d(350, 350);
  const Vector2d expected =
      fitting(pairwise_kind, "huber", "distance")->step({seen, 4}, plan).position;
  int solved = 0;
  for (const std::string& name : Registry<Solver>::instance().names()) {
    std::unique_ptr<Behaviour> made;
    try {
      made =
          behaviour(pairwise_kind,
                    {{"contact_rangeout_m", 1e4}, {"loss.kind", "huber"}, {"solver.kind", name}});
    } catch (const InputError& error) {
      EXPECT_EQ(std::string(error.what()).find("test.solver: " + name + " "), 0u) << error.what();
      continue;
    }
    ++solved;
    const Target target = made->step({seen, 4}, plan);
    EXPECT_EQ(target.reason, Reason::placed) << name;
    EXPECT_LT((target.position - expected).norm(), 0.5) << name;
  }
  EXPECT_GE(solved, 10);
}

std::string complaint(const std::string& kind, Table options) {
  try {
    behaviour(kind, options);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(FittingBehaviours, RefuseChoicesThatDoNotGoTogether) {
  std::vector<std::string> others = Registry<solvers::RegistrationSolver>::instance().names();
  std::erase(others, "procrustes");
  const std::string closed =
      "test.registration: procrustes takes the loss least_squares only; "
      "choose one of " +
      listed(others) + " for other losses";
  EXPECT_EQ(complaint(rigid_kind, {{"loss.kind", "huber"}}), closed);
  EXPECT_EQ(complaint(rigid_kind, {{"loss.kind", "tukey"}, {"registration.kind", "procrustes"}}),
            closed);
  EXPECT_EQ(complaint(rigid_kind, {{"registration.kind", "newton"}}), "");
  EXPECT_EQ(complaint(pairwise_kind, {{"loss.kind", "huber"}, {"normalisation", "count"}}),
            "test.loss: huber does not go with normalisation = \"count\", which shrinks a mean; "
            "choose normalisation = \"weights\", or the loss least_squares");
  EXPECT_EQ(complaint(pairwise_kind, {{"normalisation", "count"}}), "");
  EXPECT_EQ(complaint(rigid_kind, {{"wieghting", "none"}}),
            "test has no option \"wieghting\"; did you mean \"weighting\"?");
}

TEST(FittingBehaviours, PointAtTheChoiceThatWasWritten) {
  const Origin loss_line{"my.toml", 3}, solver_line{"my.toml", 7};
  Setting table;
  assign(table, "loss.kind", Setting{"cauchy", loss_line});
  const auto message = [&] {
    try {
      Registry<Behaviour>::instance().make(rigid_kind, table, "behaviour." + rigid_kind);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const std::string key = "behaviour.rigid_registration.registration: procrustes takes";
  EXPECT_EQ(message().find("my.toml:3: " + key), 0u) << message();
  assign(table, "registration.kind", Setting{"procrustes", solver_line});
  EXPECT_EQ(message().find("my.toml:7: " + key), 0u) << message();
}

}  // namespace
}  // namespace shoal::formations
