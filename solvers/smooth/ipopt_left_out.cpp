// In the place of ipopt.cpp where shoal is built without Ipopt.

#include "shoal/solvers/smooth/limits.hpp"
#include "shoal/solvers/solver.hpp"

namespace shoal::solvers {
namespace {

class LeftOut final : public Solver {
 public:
  Solution solve(const Problem& problem) const override { return refused(problem); }

  std::optional<std::string> refuses(const Problem&) const override {
    return "is not there: shoal was built without Ipopt (SHOAL_IPOPT=OFF)";
  }
};

struct LeftOutOptions : Limits {
  static void declare(Options<LeftOutOptions>& o) { declare_limits(o); }
};

const Register<Solver, LeftOutOptions> registered{
    "ipopt", "Ipopt, which this build was made without",
    [](const LeftOutOptions&) { return std::make_unique<LeftOut>(); }};

}  // namespace
}  // namespace shoal::solvers
