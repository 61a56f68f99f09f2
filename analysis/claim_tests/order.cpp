#include <cmath>

#include "shoal/analysis/study/claim.hpp"

namespace shoal::analysis {
namespace {

std::vector<CellSelection> selections(const Setting& list) {
  const auto* entries = std::get_if<Setting::List>(&list.value);
  if (!entries || entries->empty()) {
    throw InputError(list.origin, "than takes a list of tables, [{ factor = \"label\" }]");
  }
  std::vector<CellSelection> all;
  for (const Setting& entry : *entries) all.emplace_back(entry);
  return all;
}

struct OrderOptions {
  Setting cells, than;
  double by_percent = 0.0;
  Origin origin;

  static void declare(Options<OrderOptions>& o) {
    using O = OrderOptions;
    o.setting("cells", &O::cells, "a table: factor = label", "the cells that are said to be so");
    o.setting("than", &O::than, "a list of tables: factor = label", "those they are compared with");
    o.number("by_percent", &O::by_percent, "%", at_least(0),
             "how much of the other's value the difference must exceed");
  }
};

/// One level gives less (or more) than others, seed by seed.
class Order final : public ClaimTest {
 public:
  Order(const OrderOptions& options, double sign)
      : cells_(options.cells),
        than_(selections(options.than)),
        share_(options.by_percent / 100.0),
        sign_(sign) {}

  std::vector<std::string> compared() const override { return cells_.factors(); }

  std::vector<Contrast> contrasts(const ClaimScope& scope) const override {
    const auto ours = scope.answers(scope.cell(cells_));
    std::vector<Contrast> contrasts;
    for (const CellSelection& other : than_) {
      const auto theirs = scope.answers(scope.cell(other));
      Contrast contrast{cells_.text() + " - " + other.text(), {}, {}, {}};
      for (std::size_t k = 0; k < ours.size(); ++k) {
        if (!ours[k] || !theirs[k]) continue;
        contrast.numbers.push_back(*ours[k] - *theirs[k] - sign_ * share_ * std::abs(*theirs[k]));
      }
      (sign_ > 0.0 ? contrast.low : contrast.high) = 0.0;
      contrasts.push_back(std::move(contrast));
    }
    return contrasts;
  }

 private:
  CellSelection cells_;
  std::vector<CellSelection> than_;
  double share_, sign_;
};

const Enrol<ClaimTest, OrderOptions> lower{
    "lower", "one level gives less than others, seed by seed",
    [](const OrderOptions& options) { return std::make_unique<Order>(options, -1.0); }};
const Enrol<ClaimTest, OrderOptions> higher{
    "higher", "one level gives more than others, seed by seed",
    [](const OrderOptions& options) { return std::make_unique<Order>(options, 1.0); }};

}  // namespace
}  // namespace shoal::analysis
