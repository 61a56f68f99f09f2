#include "shoal/solvers/smooth/ipopt.hpp"

#include <coin/IpIpoptApplication.hpp>
#include <coin/IpTNLP.hpp>
#include <mutex>
#include <utility>
#include <vector>

#include "shoal/solvers/smooth/attempt.hpp"

namespace shoal::solvers {
namespace {

using Ipopt::Index;
using Ipopt::Number;

/// MUMPS keeps state that all solves of a process share: two at a time end the process. The same
/// thread may nest them, since its inner solve lies between two calls of the outer one's MUMPS.
std::recursive_mutex& mumps() {
  static std::recursive_mutex mutex;
  return mutex;
}

class Posed final : public Ipopt::TNLP {
 public:
  Posed(Attempt& attempt, double x_tolerance_m)
      : attempt_(attempt),
        tolerance_(x_tolerance_m),
        n_(attempt.unknowns()),
        curved_(attempt.hessian_pattern()) {
    for (int k = 0; k < attempt.constraints() + attempt.equalities(); ++k) {
      unknowns_.push_back(attempt.unknowns_of_constraint(k));
      entries_ += static_cast<Index>(unknowns_.back().size());
    }
  }

  bool get_nlp_info(Index& n, Index& m, Index& jacobian_entries, Index& hessian_entries,
                    IndexStyleEnum& style) override {
    n = n_;
    m = attempt_.constraints() + attempt_.equalities();
    jacobian_entries = entries_;
    hessian_entries = static_cast<Index>(curved_.size());
    style = C_STYLE;
    return true;
  }

  bool get_bounds_info(Index, Number* lower, Number* upper, Index m, Number* g_lower,
                       Number* g_upper) override {
    constexpr Number none = 2e19;  // anything beyond 1e19 is no bound
    for (int k = 0; k < n_; ++k) {
      lower[k] = attempt_.bounded() ? std::max(attempt_.lower()[k], -none) : -none;
      upper[k] = attempt_.bounded() ? std::min(attempt_.upper()[k], none) : none;
    }
    for (Index k = 0; k < m; ++k) {
      g_lower[k] = 0.0;
      g_upper[k] = k < attempt_.constraints() ? none : 0.0;
    }
    return true;
  }

  bool get_starting_point(Index, bool, Number* y, bool, Number*, Number*, Index, bool,
                          Number*) override {
    const Problem::Vector start = attempt_.start();
    std::copy_n(start.data(), n_, y);
    return true;
  }

  bool eval_f(Index, const Number* y, bool is_new, Number& value) override {
    if (!at(y, is_new)) return false;
    value = cost_;
    return true;
  }

  bool eval_grad_f(Index, const Number* y, bool is_new, Number* gradient) override {
    if (!at(y, is_new)) return false;
    std::copy_n(gradient_.data(), n_, gradient);
    return true;
  }

  bool eval_g(Index, const Number* y, bool is_new, Index m, Number* g) override {
    if (!at(y, is_new)) return false;
    for (Index k = 0; k < m; ++k) {
      if (attempt_.constrain(k, y, g[k]) != Attempt::Outcome::fine) return false;
    }
    return true;
  }

  bool eval_jac_g(Index, const Number* y, bool is_new, Index m, Index, Index* row, Index* column,
                  Number* values) override {
    if (row) {
      for (Index k = 0; k < m; ++k) {
        for (const int i : unknowns_of(k)) {
          *row++ = k;
          *column++ = i;
        }
      }
      return true;
    }
    if (!at(y, is_new)) return false;
    for (Index k = 0; k < m; ++k) {
      double value = 0.0;
      if (attempt_.constrain(k, y, value, row_.data()) != Attempt::Outcome::fine) return false;
      for (const int i : unknowns_of(k)) *values++ = row_[i];
    }
    return true;
  }

  bool eval_h(Index, const Number* y, bool is_new, Number cost_factor, Index m,
              const Number* multiplier, bool, Index, Index* row, Index* column,
              Number* values) override {
    if (row) {
      for (const auto& [i, j] : curved_) {
        *row++ = i;
        *column++ = j;
      }
      return true;
    }
    if (!at(y, is_new)) return false;
    Eigen::MatrixXd sum = cost_factor * hessian_, hessian(n_, n_);
    for (Index k = 0; k < m; ++k) {
      if (attempt_.linear_constraint(k)) continue;
      double value = 0.0;
      if (attempt_.constrain(k, y, value, row_.data(), hessian.data()) != Attempt::Outcome::fine) {
        return false;
      }
      sum += multiplier[k] * hessian;
    }
    for (const auto& [i, j] : curved_) *values++ = sum(j, i);
    return true;
  }

  // Its own tolerance is on the optimality of a scaled problem, not in metres.
  bool intermediate_callback(Ipopt::AlgorithmMode mode, Index iteration, Number,
                             Number infeasibility, Number, Number barrier, Number step_norm, Number,
                             Number, Number step_share, Index, const Ipopt::IpoptData*,
                             Ipopt::IpoptCalculatedQuantities*) override {
    if (attempt_.must_stop()) return false;
    const bool short_step = iteration > 0 && mode == Ipopt::RegularMode && infeasibility < 1e-8 &&
                            barrier < 1e-8 && step_share == 1.0 && step_norm <= tolerance_;
    return !short_step;
  }

  void finalize_solution(Ipopt::SolverReturn, Index, const Number*, const Number*, const Number*,
                         Index, const Number*, const Number*, Number, const Ipopt::IpoptData*,
                         Ipopt::IpoptCalculatedQuantities*) override {}

 private:
  // Everything is computed at once when a point is new, and counts as one evaluation.
  bool at(const Number* y, bool is_new) {
    if (is_new || !known_) {
      known_ =
          attempt_.evaluate(y, cost_, gradient_.data(), hessian_.data()) == Attempt::Outcome::fine;
    }
    return known_;
  }

  const std::vector<int>& unknowns_of(Index k) const {
    return unknowns_[static_cast<std::size_t>(k)];
  }

  Attempt& attempt_;
  double tolerance_;
  int n_;
  const std::vector<std::pair<int, int>> curved_;
  std::vector<std::vector<int>> unknowns_;  // of each constraint
  Index entries_ = 0;
  Eigen::VectorXd row_ = Eigen::VectorXd::Zero(n_);
  bool known_ = false;
  double cost_ = 0.0;
  Eigen::VectorXd gradient_ = Eigen::VectorXd::Zero(n_);
  Eigen::MatrixXd hessian_ = Eigen::MatrixXd::Zero(n_, n_);
};

class IpoptSolver final : public Solver {
 public:
  explicit IpoptSolver(const InteriorPoint& options) : options_(options) {}

  Solution solve(const Problem& problem) const override {
    if (refuses(problem)) return refused(problem);
    Attempt attempt(problem, Limits::of(options_));
    if (!attempt.open()) return attempt.finish(0, "");

    const std::lock_guard lock(mumps());
    const Ipopt::SmartPtr<Ipopt::IpoptApplication> application = new Ipopt::IpoptApplication(false);
    const auto set = [&](const char* name, auto value) {
      if constexpr (std::is_same_v<decltype(value), const char*>) {
        application->Options()->SetStringValue(name, value);
      } else if constexpr (std::is_same_v<decltype(value), int>) {
        application->Options()->SetIntegerValue(name, value);
      } else {
        application->Options()->SetNumericValue(name, value);
      }
    };
    set("print_level", 0);
    set("sb", "yes");             // no banner
    set("option_file_name", "");  // no file of the working directory
    set("linear_solver", "mumps");
    set("tol", 1e-10);
    set("acceptable_iter", 0);  // no second-best answers
    set("bound_relax_factor", 0.0);
    const auto all_linear = [&](int from, int to) {
      for (int k = from; k < to; ++k) {
        if (!attempt.linear_constraint(k)) return "no";
      }
      return "yes";
    };
    const int m = attempt.constraints();
    set("jac_d_constant", all_linear(0, m));
    set("jac_c_constant", all_linear(m, m + attempt.equalities()));
    set("max_iter", static_cast<int>(options_.max_evaluations));
    if (application->Initialize("") != Ipopt::Solve_Succeeded) {
      return attempt.finish(0, "Ipopt did not accept its options");
    }
    const Ipopt::SmartPtr<Ipopt::TNLP> posed = new Posed(attempt, options_.x_tolerance_m);
    const Ipopt::ApplicationReturnStatus status = application->OptimizeTNLP(posed);
    return attempt.finish(status, sentence(status));
  }

  std::optional<std::string> refuses(const Problem&) const override { return std::nullopt; }

  std::optional<std::string> one_at_a_time() const override {
    return "the linear solver MUMPS shares state within a process";
  }

 private:
  static const char* sentence(Ipopt::ApplicationReturnStatus status) {
    switch (status) {
      case Ipopt::Solve_Succeeded:
        return "optimal solution found";
      case Ipopt::Infeasible_Problem_Detected:
        return "converged to a point of local infeasibility";
      case Ipopt::Search_Direction_Becomes_Too_Small:
        return "the search direction becomes too small";
      case Ipopt::User_Requested_Stop:
        return "stopped by the step or the budget";
      case Ipopt::Maximum_Iterations_Exceeded:
        return "too many iterations";
      case Ipopt::Restoration_Failed:
        return "the restoration of feasibility failed";
      case Ipopt::Invalid_Number_Detected:
        return "a value is not finite";
      default:
        return "ended early";
    }
  }

  InteriorPoint options_;
};

const Register<Solver, InteriorPoint> registered{
    "ipopt", "Ipopt: interior point with the exact Hessian; one solve at a time in a process",
    [](const InteriorPoint& options) { return std::make_unique<IpoptSolver>(options); }};

}  // namespace

void InteriorPoint::declare(Options<InteriorPoint>& o) {
  declare_limits(o);
}

}  // namespace shoal::solvers
