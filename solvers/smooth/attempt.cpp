#include "shoal/solvers/smooth/attempt.hpp"

#include <algorithm>
#include <cmath>

#include "shoal/solvers/least_squares.hpp"
#include "shoal/solvers/smooth/minimum.hpp"

namespace shoal::solvers {
namespace {

using Vector = Problem::Vector;
/// For the derivatives of few unknowns without allocating.
using Scratch = SmallVector<double, 36>;

std::size_t at(int index) {
  return static_cast<std::size_t>(index);
}

}  // namespace

Attempt::Attempt(const Problem& problem, const Limits& limits)
    : problem_(problem),
      limits_(limits),
      restricted_(problem.lower || problem.upper || problem.constrained()),
      point_(problem.start),
      best_(Vector::Constant(problem.start.size(), std::numeric_limits<double>::quiet_NaN())) {
  wrong_ = flaw();
  if (wrong_) return;
  for (int i = 0; i < problem.dimension(); ++i) {
    if (!problem.lower || (*problem.lower)[i] < (*problem.upper)[i]) free_.push_back(i);
  }
  free_count_ = static_cast<int>(free_.size());
  all_free_ = free_count_ == problem.dimension();
  open_ = free_count_ > 0;
  if (!open_) {
    double cost = 0.0;
    evaluate(nullptr, cost);
  }
  const VectorFunction* residuals =
      problem.least_squares ? problem.least_squares->residuals.get() : nullptr;
  for (int b = 0; residuals && !all_free_ && b < residuals->blocks(); ++b) {
    if (unknowns_of_residuals(b).empty()) fixed_blocks_.push_back(b);
  }
}

const char* Attempt::flaw() const {
  const Vector& start = problem_.start;
  if (start.size() < 1) return "the start has no unknowns";
  if (!start.allFinite()) return "the start is not finite";
  for (const auto& each : {problem_.constraints, problem_.equalities}) {
    if (each && each->block_size() != 1) return "constraints come in blocks of one";
  }
  if (problem_.lower.has_value() != problem_.upper.has_value()) {
    return "one of the bounds is missing; give both or none";
  }
  if (!problem_.lower) return nullptr;
  const Vector& low = *problem_.lower;
  const Vector& high = *problem_.upper;
  if (low.size() != start.size() || high.size() != start.size()) {
    return "the bounds and the start differ in size";
  }
  for (Eigen::Index i = 0; i < start.size(); ++i) {
    if (std::isnan(low[i]) || std::isnan(high[i])) return "a bound is NaN";
    if (low[i] > high[i]) return "a lower bound lies above its upper bound";
    if (start[i] < low[i] || start[i] > high[i]) return "the start lies outside the bounds";
  }
  return nullptr;
}

Vector Attempt::free_part(const Vector& all) const {
  Vector part(free_count_);
  for (int k = 0; k < free_count_; ++k) part[k] = all[free(k)];
  return part;
}

const double* Attempt::place(const double* y) {
  if (all_free_) return y;
  for (int k = 0; k < free_count_; ++k) point_[free(k)] = y[k];
  return point_.data();
}

bool Attempt::may_go_on() {
  stopped_ = stopped_ || evaluations_ >= limits_.max_evaluations;
  evaluations_ += stopped_ ? 0 : 1;
  if (problem_.trace && !stopped_) problem_.trace->count_evaluation();
  return !stopped_;
}

Attempt::Block Attempt::constraint(int k) const {
  const int first = constraints();
  if (k < first) return {*problem_.constraints, k};
  return {*problem_.equalities, k - first};
}

std::vector<int> Attempt::free_among(std::span<const int> unknowns) const {
  std::vector<int> found;
  for (int k = 0; k < free_count_; ++k) {
    if (unknowns.empty() || std::ranges::binary_search(unknowns, free(k))) found.push_back(k);
  }
  return found;
}

std::vector<int> Attempt::unknowns_of_constraint(int k) const {
  const Block block = constraint(k);
  return free_among(block.function.unknowns_of(block.place));
}

std::vector<int> Attempt::unknowns_of_residuals(int block) const {
  return free_among(problem_.least_squares->residuals->unknowns_of(block));
}

template <class Function>
Attempt::Outcome Attempt::guarded(Function function) {
  try {
    if (function()) return Outcome::fine;
  } catch (...) {
    failure_ = std::current_exception();
    stopped_ = true;
    return Outcome::stop;
  }
  met_not_finite_ = true;
  return Outcome::not_finite;
}

template <class Function>
bool Attempt::reduced(const Function& function, const double* y, double& value, double* gradient,
                      double* hessian) {
  if (all_free_) {
    value = function(y, gradient, hessian);
  } else {
    const int n = problem_.dimension();
    Scratch all_gradient(at(gradient ? n : 0)), all_hessian(at(hessian ? n * n : 0));
    value = function(place(y), gradient ? all_gradient.data() : nullptr,
                     hessian ? all_hessian.data() : nullptr);
    for (int k = 0; gradient && k < free_count_; ++k) {
      gradient[k] = all_gradient[at(free(k))];
    }
    for (int k = 0; hessian && k < free_count_ * free_count_; ++k) {
      hessian[k] = all_hessian[at(free(k / free_count_) * n + free(k % free_count_))];
    }
  }
  bool finite = std::isfinite(value);
  for (int k = 0; gradient && k < free_count_; ++k) finite &= std::isfinite(gradient[k]);
  for (int k = 0; hessian && k < free_count_ * free_count_; ++k)
    finite &= std::isfinite(hessian[k]);
  return finite;
}

std::vector<std::pair<int, int>> Attempt::hessian_pattern() const {
  using Flags = Eigen::Matrix<bool, Eigen::Dynamic, Eigen::Dynamic>;
  Flags met = Flags::Constant(free_count_, free_count_, problem_.least_squares == nullptr);
  const auto meet = [&](const std::vector<int>& unknowns) {
    for (const int i : unknowns) {
      for (const int j : unknowns) met(i, j) = true;
    }
  };
  const int blocks = problem_.least_squares ? problem_.least_squares->residuals->blocks() : 0;
  for (int b = 0; b < blocks; ++b) meet(unknowns_of_residuals(b));
  for (int k = 0; k < constraints() + equalities(); ++k) {
    if (!linear_constraint(k)) meet(unknowns_of_constraint(k));
  }
  std::vector<std::pair<int, int>> pattern;
  for (int i = 0; i < free_count_; ++i) {
    for (int j = 0; j <= i; ++j) {
      if (met(i, j)) pattern.emplace_back(i, j);
    }
  }
  return pattern;
}

Attempt::Outcome Attempt::evaluate(const double* y, double& cost, double* gradient,
                                   double* hessian) {
  if (!may_go_on()) return Outcome::stop;
  return guarded([&] {
    const auto objective = [this](const double* x, double* all_gradient, double* all_hessian) {
      return problem_.evaluate(x, all_gradient, all_hessian);
    };
    bool finite = reduced(objective, y, cost, gradient, hessian);
    if (gradient) {
      double squared = 0.0;
      for (int k = 0; k < free_count_; ++k) squared += gradient[k] * gradient[k];
      finite &= std::isfinite(squared);
      if (finite) largest_gradient_squared_ = std::max(largest_gradient_squared_, squared);
    }
    if (finite) worst_cost_ = std::max(worst_cost_, cost);
    // Without bounds and constraints, most points are done with here.
    if (finite && (restricted_ || cost < best_cost_)) remember(all_free_ ? y : point_.data(), cost);
    return finite;
  });
}

Attempt::Outcome Attempt::constrain(int k, const double* y, double& value, double* gradient,
                                    double* hessian) {
  if (stopped_) return Outcome::stop;
  const auto by_all = [&](const double* x, double* all_gradient, double* all_hessian) {
    double at_x = 0.0;
    const auto [function, place] = constraint(k);
    evaluate_by_all(function, place, problem_.dimension(), x, &at_x, all_gradient, all_hessian);
    return at_x;
  };
  return guarded([&] { return reduced(by_all, y, value, gradient, hessian); });
}

Attempt::Outcome Attempt::begin_residuals() {
  if (!may_go_on()) return Outcome::stop;
  cost_of_blocks_ = 0.0;
  next_block_ = 0;
  return Outcome::fine;
}

/// Not finite where the loss or its derivatives are not: Ceres would end the process.
double Attempt::cost_of(int block, const double* residuals) const {
  const LeastSquares& structure = *problem_.least_squares;
  double squared = 0.0;
  for (int r = 0; r < structure.residuals->block_size(); ++r) {
    squared += residuals[r] * residuals[r];
  }
  const LossValue loss = structure.loss_at(squared);
  if (!std::isfinite(loss.value + loss.slope + loss.curvature)) {
    return std::numeric_limits<double>::infinity();
  }
  return structure.weight(block) * loss.value;
}

Attempt::Outcome Attempt::residuals(int block, const double* y, double* values, double* jacobian) {
  if (stopped_) return Outcome::stop;
  return guarded([&] {
    const LeastSquares& structure = *problem_.least_squares;
    const std::span<const int> own = structure.residuals->unknowns_of(block);
    const int m = structure.residuals->block_size();
    const int n = own.empty() ? problem_.dimension() : static_cast<int>(own.size());
    const double* x = place(y);
    Scratch whole(at(jacobian ? m * n : 0));
    structure.residuals->evaluate(block, x, values, jacobian ? whole.data() : nullptr, nullptr);
    double squared = 0.0;
    bool finite = true;
    for (int r = 0; r < m; ++r) {
      squared += values[r] * values[r];
    }
    for (int r = 0; jacobian && r < m; ++r) {
      for (int i = 0, k = 0; i < n; ++i) {
        const int unknown = own.empty() ? i : own[at(i)];
        while (k < free_count_ && free(k) < unknown) ++k;
        if (k == free_count_ || free(k) != unknown) continue;
        *jacobian = whole[at(r * n + i)];
        finite &= std::isfinite(*jacobian++);
      }
    }
    if (!finite || !std::isfinite(squared)) return false;
    const auto take = [&](const double* seen) {
      const double cost = cost_of(next_block_, seen);
      cost_of_blocks_ += cost;
      ++next_block_;
      return std::isfinite(cost);
    };
    const auto take_fixed = [&] {
      double fixed[VectorFunction::max_block_size];
      while (std::ranges::binary_search(fixed_blocks_, next_block_)) {
        structure.residuals->evaluate(next_block_, x, fixed, nullptr, nullptr);
        if (!take(fixed)) return false;
      }
      return true;
    };
    if (!take_fixed()) return false;
    if (block == next_block_) {  // seen for the first time at this point
      if (!take(values) || !take_fixed()) return false;
      if (next_block_ == structure.residuals->blocks()) remember(x, cost_of_blocks_);
    }
    return true;
  });
}

// Of two points the one that breaks its constraints less is better, of two that keep to them the
// one that costs less.
void Attempt::remember(const double* x, double cost) {
  double violation = 0.0;
  if (restricted_) {
    const Eigen::Map<const Eigen::VectorXd> here(x, point_.size());
    const double outside = bounds_violation(problem_, here);
    const double broken = constraint_violation(problem_, here);
    if (std::isnan(broken)) return;
    violation = outside > 0.0 || broken > feasibility ? std::max(outside, broken) : 0.0;
    const bool first = best_cost_ == std::numeric_limits<double>::infinity();
    if (!first && violation > best_violation_) return;
    if (first || violation < best_violation_) best_cost_ = std::numeric_limits<double>::infinity();
  }
  if (!(cost < best_cost_)) return;
  for (Eigen::Index i = 0; i < best_.size(); ++i) best_[i] = x[i];
  best_cost_ = cost;
  best_violation_ = violation;
  if (problem_.trace && violation == 0.0) problem_.trace->note(cost);
}

Solution Attempt::finish(int code, const char* says) {
  if (failure_) std::rethrow_exception(failure_);
  if (wrong_) return answer(Status::bad_input, 0, wrong_);
  if (!open_) return answer(judge(), 0, "every unknown is fixed by its bounds");
  return answer(judge(), code, says);
}

Solution Attempt::finish_converged(const char* says) {
  return answer(Status::converged, 0, says);
}

bool Attempt::may_end_after(double step) {
  constexpr int patience = 20;
  short_steps_ = step <= limits_.x_tolerance_m ? short_steps_ + 1 : 0;
  return short_steps_ > 0 && (short_steps_ > patience || at_minimum());
}

bool Attempt::at_minimum() const {
  double largest_gradient = std::sqrt(largest_gradient_squared_);
  if (largest_gradient == 0.0) {  // of a method without derivatives: that at the start will do
    Vector gradient(problem_.dimension());
    problem_.evaluate(problem_.start.data(), gradient.data());
    if (gradient.allFinite()) largest_gradient = gradient.norm();
  }
  return is_local_minimum(problem_, best_, limits_.x_tolerance_m, largest_gradient);
}

Status Attempt::judge() const {
  if (std::isinf(best_cost_)) return Status::diverged;
  if (best_violation_ > 0.0) return Status::infeasible;
  if (!open_) return Status::converged;
  if (at_minimum()) return Status::converged;
  if (met_not_finite_) return Status::diverged;
  if (evaluations_ >= limits_.max_evaluations) return Status::budget;
  return Status::stalled_at_roundoff;
}

Solution Attempt::answer(Status status, int code, const char* says) const {
  Solution solution;
  solution.x = best_;
  if (std::isfinite(best_cost_)) solution.cost = best_cost_;
  solution.status = status;
  solution.backend_code = code;
  solution.backend_says = says;
  if (std::isfinite(best_cost_) && restricted_) {
    solution.violation =
        std::max(bounds_violation(problem_, best_), constraint_violation(problem_, best_));
  }
  solution.evaluations = static_cast<int>(evaluations_);
  solution.seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
  return solution;
}

}  // namespace shoal::solvers
