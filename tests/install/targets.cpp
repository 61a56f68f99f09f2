// Targets of every behaviour with its defaults in drawn neighbourhoods, one a line with all digits:
// what two builds for different processors are compared by.

#include <cstdint>
#include <cstdio>
#include <memory>
#include <shoal/core/registry.hpp>
#include <shoal/formations/planner.hpp>
#include <string>
#include <vector>

using Eigen::Vector2d;
using namespace shoal::formations;

namespace {

/// Numbers from 0 to 1 that are the same everywhere: Knuth's MMIX generator.
class Drawn {
 public:
  double operator()() {
    state_ = 6364136223846793005u * state_ + 1442695040888963407u;
    return static_cast<double>(state_ >> 11) * 0x1p-53;
  }
  int below(int most) { return static_cast<int>((*this)() * most); }

 private:
  std::uint64_t state_ = 1;
};

}  // namespace

int main() {
  std::vector<std::string> names;
  std::vector<Vector2d> slots;
  for (int k = 0; k < 20; ++k) {
    names.push_back("v" + std::to_string(k));
    slots.emplace_back(300.0 * (k % 5), 300.0 * (k / 5));
  }
  const Plan plan(names, slots);
  const auto& behaviours = shoal::Registry<Behaviour>::instance();
  for (const shoal::MemberInfo& member : behaviours.members()) {
    const auto behaviour = behaviours.make(member.name, {}, "behaviour");
    Drawn drawn;
    for (int k = 0; k < 500; ++k) {
      const int own = drawn.below(20);
      std::vector<Neighbour> neighbours;
      for (int other = 0; other < 20; ++other) {
        if (other == own || drawn() < 0.6) continue;
        Neighbour neighbour{.position = slots[static_cast<std::size_t>(other)] -
                                        slots[static_cast<std::size_t>(own)],
                            .slot = other};
        // One after another: arguments of a function are evaluated in an order of the compiler's.
        neighbour.position.x() += 60.0 * (drawn() - 0.5);
        neighbour.position.y() += 60.0 * (drawn() - 0.5);
        neighbour.age_s = 60.0 * drawn();
        neighbours.push_back(neighbour);
      }
      const Target target = behaviour->step(
          {.neighbours = neighbours, .own_slot = own, .waypoint = Vector2d(1000.0, -400.0)}, plan);
      const Vector2d answer = target.force_m_s2.value_or(target.position);
      std::printf("%s %d %d %.17g %.17g\n", member.name.c_str(), k, static_cast<int>(target.reason),
                  answer.x(), answer.y());
    }
  }
}
