#include "shoal/analysis/experiments/claims/tests/margin.hpp"

namespace shoal::analysis {
namespace {

struct OrderOptions : WithSmallestEffect {
  Setting cells, than;

  static void declare(Options<OrderOptions>& o) {
    using O = OrderOptions;
    o.setting("cells", &O::cells, "a table: factor = label", "the cells that are said to be so");
    o.setting("than", &O::than, "a table or a list of tables: factor = label",
              "those they are compared with");
    declare_smallest_effect(o);
  }
};

/// One level gives less (or more) than others, seed by seed.
class Order final : public ClaimTest {
 public:
  Order(const OrderOptions& options, double sign)
      : cells_(options.cells),
        than_(cell_selections(options.than, "than")),
        margin_(options.margin()),
        sign_(sign) {}

  std::vector<std::string> compared() const override { return factors_of(cells_, than_); }

  std::vector<Contrast> contrasts(const ClaimScope& scope) const override {
    const CellPlace ours = scope.cell(cells_);
    std::vector<Contrast> contrasts;
    for (const CellSelection& other : than_) {
      contrasts.push_back(directed_difference(scope, ours, scope.cell(other), sign_, margin_));
      contrasts.back().title = cells_.text() + " - " + other.text();
    }
    return contrasts;
  }

 private:
  CellSelection cells_;
  std::vector<CellSelection> than_;
  Margin margin_;
  double sign_;
};

const Register<ClaimTest, OrderOptions> lower{
    "lower", "one level gives less than others by an effect that matters, seed by seed",
    [](const OrderOptions& options) { return std::make_unique<Order>(options, -1.0); }};
const Register<ClaimTest, OrderOptions> higher{
    "higher", "one level gives more than others by an effect that matters, seed by seed",
    [](const OrderOptions& options) { return std::make_unique<Order>(options, 1.0); }};

}  // namespace
}  // namespace shoal::analysis
