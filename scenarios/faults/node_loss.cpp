#include "shoal/scenarios/faults/fault.hpp"

namespace shoal::scenarios {
namespace {

/// Random vehicles lost one after the other: Rypkema 2015, sec. 4.4.
struct NodeLoss final : Fault {
  double period_s = 0.0;
  std::int64_t number = 0;

  std::int64_t count() const override { return number; }
  double every_s() const override { return period_s; }

  void lose(std::span<const std::size_t> left, std::size_t gone, const RandomStreams& random,
            std::vector<std::size_t>& lost) const override {
    const double u = random.uniform(Purpose::node_loss, 0, gone)[0];
    const auto place = static_cast<std::size_t>(u * static_cast<double>(left.size()));
    if (place < left.size()) lost.push_back(left[place]);
  }

  static void declare(Options<NodeLoss>& o) {
    o.number("every_s", &NodeLoss::period_s, "s", at_least(0), "time between two losses");
    o.integer("count", &NodeLoss::number, "", in(0, 1e6), "how many vehicles are lost in all");
  }

  std::optional<std::string> complaint() const {
    if (number > 0 && period_s <= 0.0) return "count is set, so every_s must be above 0 s";
    return std::nullopt;
  }
};

const Register<Fault, NodeLoss> registered{
    "node_loss", "random vehicles fall silent for good (Rypkema 2015, sec. 4.4)"};

}  // namespace
}  // namespace shoal::scenarios
