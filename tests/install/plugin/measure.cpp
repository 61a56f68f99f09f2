// A measure of your own: how far east the centroid is at the end.

#include <shoal/analysis/experiments/measure.hpp>

using namespace shoal;
using namespace shoal::analysis;

struct MyEasting final : Measure {
  double from_m = 0.0;

  static void declare(Options<MyEasting>& o) {
    o.number("from_m", &MyEasting::from_m, "m", {}, "what it is measured from");
  }

  std::vector<Quantity> values() const override {
    return {{"my_easting_m", "m", "how far east the centroid is at the end"}};
  }
  void finish(const scenarios::World& world, Results& results) const override {
    const auto x = over_survivors(world, [&](std::size_t i) { return world.swarm().x_m[i]; });
    results.add("my_easting_m", x ? std::optional(x->mean - from_m) : std::nullopt);
  }
};

const Register<Measure, MyEasting> registered{"my_easting", "how far east the swarm has gone"};
