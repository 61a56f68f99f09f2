#include "shoal/analysis/experiments/measure.hpp"
#include "shoal/analysis/experiments/measures/held_slots.hpp"
#include "shoal/analysis/experiments/measures/lattice_occupation.hpp"
#include "shoal/formations/lattice_symmetry.hpp"
#include "shoal/solvers/registration/registration.hpp"

namespace shoal::analysis {
namespace {

/// What has become of the lattice at the end of the mission: is it whole (Rypkema 2015, sec. 5.1.1,
/// 5.2.1), and are vehicles on its points (sec. 5.4)? Slots are those of the padded plan as the
/// formation quality lays it onto the vehicles. Only where the quality is measured.
class Lattice final : public Measure {
 public:
  // Vehicles farther apart than this look apart in the figures of Rypkema 2015, chapter 5: between
  // the diagonal of a square of the lattice and the second neighbours of a hexagon.
  double together_spacings = 1.5;
  double on_point_spacings = 0.2;

  static void declare(Options<Lattice>& o) {
    o.number("together_spacings", &Lattice::together_spacings, "", above(0),
             "vehicles this many separations apart, or less, are of one group");
    o.number("on_point_spacings", &Lattice::on_point_spacings, "", above(0),
             "a vehicle this many separations from its slot, or less, is on it");
  }

  std::vector<Quantity> values() const override {
    return {
        {"separate_groups", "",
         "groups farther apart than measure.lattice.together_spacings, at the end"},
        {"lattice_holes", "", "groups of empty slots closed in by vehicles, at the end"},
        {"lattice_defects", "", "holes, and groups beyond the first, at the end"},
        {"on_lattice_share", "",
         "share of vehicles within measure.lattice.on_point_spacings of their slots, at the end"},
        {"outside_outline_vehicles", "",
         "vehicles on slots outside the outline of the plan, at the end"}};
  }

  void finish(const scenarios::World& world, Results& results) const override {
    std::vector<Eigen::Vector2d> places;
    std::vector<int> vehicles;
    survivors(world, places, vehicles);
    if (world.scenario().quality.every_s <= 0.0 || places.size() < 2) {
      for (const Quantity& quantity : values()) results.add(quantity.name, std::nullopt);
      return;
    }
    const HeldSlots held = held_slots(world, places);
    const std::vector<Eigen::Vector2d> slots = held.positions();
    std::vector<bool> taken(static_cast<std::size_t>(held.padded.size()));
    solvers::Procrustes registration;
    for (std::size_t i = 0; i < places.size(); ++i) {
      taken[static_cast<std::size_t>(held.slot[i])] = true;
      registration.add(slots[i], places[i], 1.0);
    }
    const Transform2 T_world_plan = registration.solve().T_to_from;
    const double spacing_m = least_spacing_m(world.plan().slots());
    int on_points = 0;
    for (std::size_t i = 0; i < places.size(); ++i) {
      const double off_m = (T_world_plan * slots[i] - places[i]).norm();
      on_points += off_m <= on_point_spacings * spacing_m ? 1 : 0;
    }
    const int groups = groups_within(places, together_spacings * spacing_m);
    const int empty = holes(held.padded.slots(), taken);
    results.add("separate_groups", groups);
    results.add("lattice_holes", empty);
    results.add("lattice_defects", empty + groups - 1);
    results.add("on_lattice_share", on_points / static_cast<double>(places.size()));
    results.add(
        "outside_outline_vehicles",
        outside_outline(slots, world.plan().slots(), formations::lattice_symmetry(world.plan())));
  }
};

const Register<Measure, Lattice> registered{"lattice",
                                            "is the lattice whole, and are vehicles on its points"};

}  // namespace
}  // namespace shoal::analysis
