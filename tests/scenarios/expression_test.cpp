// A potential written as text, in a whole trial.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "shoal/scenarios/scenario.hpp"
#include "shoal/scenarios/toml_file.hpp"
#include "shoal/scenarios/world.hpp"

namespace shoal::scenarios {
namespace {

const char* const potential = "behaviour.attraction_repulsion.potential.";

Scenario scenario_with(const std::vector<std::string>& more) {
  Setting root;
  for (const char* set : {"plan.square={rows=3,columns=3}", "trial.duration_s=900",
                          "behaviour.kind=attraction_repulsion", "quality.every_s=0"}) {
    apply_set(root, set);
  }
  for (const std::string& set : more) apply_set(root, potential + set);
  return read_scenario(root);
}

class Track final : public Observer {
 public:
  std::vector<double> x_m, y_m;

  double every_s() const override { return 10.0; }
  void observe(const World& world) override {
    x_m.insert(x_m.end(), world.swarm().x_m.begin(), world.swarm().x_m.end());
    y_m.insert(y_m.end(), world.swarm().y_m.begin(), world.swarm().y_m.end());
  }
};

Track track(const Scenario& s) {
  Track seen;
  Observer* observers[] = {&seen};
  World(s).run(observers);
  return seen;
}

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double largest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
  return largest;
}

TEST(Expression, OfEquation33GivesTheTrajectoriesOfTheBuiltIn) {
  const Track built_in = track(scenario_with({}));
  for (const char* formula : {"s^3/(2*r^2) + r - 3*s", "r + s*((s/r)^2/2 - 3)"}) {
    const Track written = track(
        scenario_with({"kind=expression", "expression.formula=\"" + std::string(formula) + '"'}));
    ASSERT_EQ(written.x_m.size(), built_in.x_m.size());
    EXPECT_LT(largest_difference(written.x_m, built_in.x_m), 1e-9) << formula;
    EXPECT_LT(largest_difference(written.y_m, built_in.y_m), 1e-9) << formula;
  }
  EXPECT_GT(largest_difference(built_in.x_m, track(scenario_with({"kind=virtual_spring"})).x_m),
            1.0);
}

}  // namespace
}  // namespace shoal::scenarios
