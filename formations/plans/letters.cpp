#include <array>

#include "shoal/formations/plan.hpp"

namespace shoal::formations {
namespace {

/// The letters NR, 22 slots of about 100 m spacing (Rypkema 2015, fig. 3.12 and 3.14; coordinates
/// as in the plan of that mission).
constexpr std::array<std::array<double, 2>, 22> letters_nr_m{{
    {0, 0},     {0, 100},   {0, 200},   {0, 300},                // N: left stem
    {75, 230},  {150, 150}, {225, 70},                           // diagonal
    {300, 0},   {300, 100}, {300, 200}, {300, 300},              // right stem
    {500, 0},   {500, 100}, {500, 200}, {500, 300},              // R: stem
    {575, 300}, {690, 290}, {800, 250}, {690, 160}, {575, 150},  // bowl
    {687, 75},  {800, 0},                                        // leg
}};

struct Letters final : PlanSource {
  double scale = 1.0;
  Origin origin;

  static void declare(Options<Letters>& o) {
    o.number("scale", &Letters::scale, "", above(0), "size, 1 being 800 m x 300 m");
  }

  Plan plan() const override {
    std::vector<std::string> names;
    std::vector<Eigen::Vector2d> slots;
    for (const auto& [x, y] : letters_nr_m) {
      names.push_back("NODE_" + std::to_string(names.size() + 1));
      slots.emplace_back(scale * x, scale * y);
    }
    return Plan(std::move(names), std::move(slots), origin).centred();
  }
};

const Register<PlanSource, Letters> registered{
    "letters", "the letters NR, for 22 vehicles (Rypkema 2015, fig. 3.12)"};

}  // namespace
}  // namespace shoal::formations
