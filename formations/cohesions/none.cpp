#include "shoal/formations/cohesion.hpp"

namespace shoal::formations {
namespace {

struct None final : Cohesion {
  Eigen::Vector2d anchor(std::span<const Neighbour>, const Eigen::Vector2d&) const override {
    return Eigen::Vector2d::Zero();
  }
  PlaneValue at(const Eigen::Vector2d&) const override { return {}; }

  static void declare(Options<None>&) {}
};

const Register<Cohesion, None> registered{"none", "nothing but the pair potentials"};

}  // namespace
}  // namespace shoal::formations
