// A behaviour of your own: to the centroid of the neighbours.

#include <shoal/formations/behaviour.hpp>

using namespace shoal;
using namespace shoal::formations;

struct MyGathering final : Behaviour {
  using Behaviour::step;
  Target step(const Neighbourhood& seen, const Plan&, const Solving&) const override {
    if (seen.neighbours.empty()) return Target::hold(Reason::no_neighbour);
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    for (const Neighbour& n : seen.neighbours) sum += n.position;
    return Target::at(sum / static_cast<double>(seen.neighbours.size()), 0.0);
  }
  bool needs_ids() const override { return false; }

  static void declare(Options<MyGathering>&) {}
};

const Register<Behaviour, MyGathering> registered{"my_gathering",
                                                  "to the centroid of the neighbours"};
