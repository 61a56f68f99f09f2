#include "shoal/solvers/registration/descent.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "shoal/solvers/least_squares.hpp"

namespace shoal::solvers {
namespace {

using Eigen::Vector2d;

/// The pairs that count, each side about its weighted mean. Motions are from centred point to
/// centred point; costs are for weights whose sum is 1.
struct Centred {
  std::vector<Vector2d> from, to;
  std::vector<double> weights;
  Vector2d from_mean = Vector2d::Zero(), to_mean = Vector2d::Zero();
  double weight = 0.0;
  double radius = 0.0;                              // root mean square of |from|, m
  bool from_distinct = false, to_distinct = false;  // are there two distinct ones on this side?

  explicit Centred(std::span<const PointPair> pairs) {
    // About the first pair, so that far-away swarms lose no digits.
    for (const PointPair& pair : pairs) {
      if (!(pair.weight > 0.0)) continue;
      if (weights.empty()) {
        from_origin_ = pair.from;
        to_origin_ = pair.to;
      }
      from.push_back(pair.from - from_origin_);
      to.push_back(pair.to - to_origin_);
      weights.push_back(pair.weight);
      weight += pair.weight;
      from_distinct = from_distinct || from.back() != from.front();
      to_distinct = to_distinct || to.back() != to.front();
    }
    for (double& w : weights) w /= weight;
    for (std::size_t i = 0; i < size(); ++i) {
      from_mean += weights[i] * from[i];
      to_mean += weights[i] * to[i];
    }
    for (std::size_t i = 0; i < size(); ++i) {
      from[i] -= from_mean;
      to[i] -= to_mean;
      radius += weights[i] * from[i].squaredNorm();
    }
    radius = std::sqrt(radius);
    from_mean += from_origin_;
    to_mean += to_origin_;
  }

  std::size_t size() const { return weights.size(); }

  double cost(const Transform2& motion, const Loss& loss) const {
    double sum = 0.0;
    for (std::size_t i = 0; i < size(); ++i) {
      sum += weights[i] * loss.at((motion * from[i] - to[i]).squaredNorm()).value;
    }
    return sum;
  }

 private:
  Vector2d from_origin_ = Vector2d::Zero(), to_origin_ = Vector2d::Zero();
};

/// What two pairs alone say: the rotation from their direction, the shift from their middle.
std::optional<Transform2> from_two(const Centred& points, std::size_t i, std::size_t j) {
  const Vector2d planned = points.from[j] - points.from[i];
  const Vector2d actual = points.to[j] - points.to[i];
  const double lengths = planned.norm() * actual.norm();
  if (!(lengths > 0.0)) return std::nullopt;
  Transform2 motion{planned.dot(actual) / lengths,
                    (planned.x() * actual.y() - planned.y() * actual.x()) / lengths,
                    Vector2d::Zero()};
  motion.translation =
      0.5 * (points.to[i] + points.to[j] - motion.rotate(points.from[i] + points.from[j]));
  return motion;
}

/// The cheapest motion that two pairs fix, or, without rotation, one pair.
Transform2 agreed_start(const Centred& points, const Loss& loss, bool turns) {
  constexpr std::size_t most = 64;
  const std::size_t count = std::min(points.size(), most);
  const auto spread = [&](std::size_t k) { return k * points.size() / count; };
  Transform2 best;
  double least = std::numeric_limits<double>::infinity();
  const auto consider = [&](const Transform2& motion) {
    const double cost = points.cost(motion, loss);
    if (!(cost < least)) return;
    least = cost;
    best = motion;
  };
  for (std::size_t a = 0; a < count; ++a) {
    const std::size_t i = spread(a);
    if (!turns) {
      consider({1.0, 0.0, points.to[i] - points.from[i]});
      continue;
    }
    for (std::size_t b = a + 1; b < count; ++b) {
      if (const auto motion = from_two(points, i, spread(b))) consider(*motion);
    }
  }
  return best;
}

/// How far the moved points are from their places. Unknowns: arc and shift, or the shift alone, in
/// addition to a first motion.
template <int N>
class Misplacement final : public VectorFunction {
 public:
  Misplacement(const Centred& points, const Transform2& first)
      : to_(points.to), radius_(points.radius) {
    for (const Vector2d& p : points.from) from_.push_back(first.rotate(p));
    for (Vector2d& p : to_) p -= first.translation;
  }

  int blocks() const override { return static_cast<int>(from_.size()); }
  int block_size() const override { return 2; }

  void evaluate(int block, const double* u, double* values, double* jacobian,
                double* hessians) const override {
    const auto b = static_cast<std::size_t>(block);
    Vector2d turned = from_[b];
    if constexpr (N == 3) {
      turned = Transform2::from_angle(u[0] / radius_, Vector2d::Zero()).rotate(turned);
    }
    Eigen::Map<Vector2d>{values} = turned + Eigen::Map<const Vector2d>(u + N - 2) - to_[b];
    if (jacobian) {
      Eigen::Map<Eigen::Matrix<double, 2, N, Eigen::RowMajor>> slopes(jacobian);
      slopes.template rightCols<2>().setIdentity();
      if constexpr (N == 3) slopes.col(0) = Vector2d(-turned.y(), turned.x()) / radius_;
    }
    if (hessians) {
      constexpr int entries = N * N;
      std::fill_n(hessians, 2 * entries, 0.0);
      if constexpr (N == 3) {
        hessians[0] = -turned.x() / (radius_ * radius_);
        hessians[entries] = -turned.y() / (radius_ * radius_);
      }
    }
  }

 private:
  std::vector<Vector2d> from_;  // already turned by the first motion
  std::vector<Vector2d> to_;    // seen from where the first motion shifts to
  double radius_;
};

template <int N>
Problem pose(const Centred& points, const Transform2& first, const Loss* loss) {
  LeastSquares structure{std::make_shared<const Misplacement<N>>(points, first),
                         std::shared_ptr<const Loss>(std::shared_ptr<const Loss>(), loss),
                         points.weights};
  return least_squares_problem(Eigen::Matrix<double, N, 1>::Zero(), std::move(structure));
}

/// Whether the cost, minimised over the shift, curves along the arc. It does not where all pairs
/// but one lie beyond the reach of the loss.
bool fixes_rotation(const Problem& problem, const Problem::Vector& u) {
  constexpr double rounding = 1e-12;
  Eigen::Vector3d slope;
  Eigen::Matrix3d curvature;
  problem.evaluate(u.data(), slope.data(), curvature.data());
  const Eigen::Matrix2d of_shift = curvature.bottomRightCorner<2, 2>();
  if (!(of_shift.determinant() > 0.0)) return false;
  const Vector2d mixed = curvature.bottomLeftCorner<2, 1>();
  const double along = curvature(0, 0) - mixed.dot(of_shift.inverse() * mixed);
  return along > rounding * of_shift.trace();
}

bool minimum(const Solution& solution) {
  return solution.status == Status::converged || solution.status == Status::target_reached;
}

struct Descended {
  Transform2 motion;
  Solution solution;
  bool rotation_fixed = true;
};

template <int N>
Descended descend(const Solver& solver, const Centred& points, const Transform2& first,
                  const RegistrationProblem& registration) {
  Problem problem = pose<N>(points, first, registration.loss);
  problem.trace = registration.trace;
  Descended end{first, {}};
  // Some backends end the process where they should say so.
  end.solution.status = Status::diverged;
  if (!std::isfinite(problem.evaluate(problem.start.data()))) return end;
  end.solution = solver.solve(problem);
  if (!end.solution.usable()) return end;
  const Problem::Vector& u = end.solution.x;
  end.motion.translation += u.tail<2>();
  if constexpr (N == 3) {
    const Transform2 turn = Transform2::from_angle(u[0] / points.radius, Vector2d::Zero());
    end.motion = {turn.cosine * first.cosine - turn.sine * first.sine,
                  turn.sine * first.cosine + turn.cosine * first.sine, end.motion.translation};
    // On the way to a minimum the curvature says nothing.
    if (minimum(end.solution)) end.rotation_fixed = fixes_rotation(problem, u);
  }
  return end;
}

/// The lowest answer from one start for the square, from two for other losses.
template <int N>
Descended lowest(const Solver& solver, const Centred& points, const Transform2& of_squares,
                 const RegistrationProblem& problem) {
  Descended best = descend<N>(solver, points, of_squares, problem);
  if (problem.is_square()) return best;
  const Transform2 agreed = agreed_start(points, *problem.loss, N == 3);
  Descended other = descend<N>(solver, points, agreed, problem);
  const int evaluations = best.solution.evaluations + other.solution.evaluations;
  // Of two ways to the same minimum the rounding of the cost must not choose.
  constexpr double rounding = 1e-12;
  const bool lower = other.solution.cost < (1.0 - rounding) * best.solution.cost;
  if (other.solution.usable() && (lower || !best.solution.usable())) best = other;
  best.solution.evaluations = evaluations;
  return best;
}

Status status_of(const Solution& solution, bool turned) {
  if (!solution.usable() && solution.status != Status::bad_input) return Status::diverged;
  if (!minimum(solution)) return solution.status;
  return turned ? Status::converged : Status::undetermined;
}

}  // namespace

RegistrationSolution RegistrationByDescent::solve(const RegistrationProblem& problem) const {
  Procrustes sums;
  for (const PointPair& pair : problem.pairs) sums.add(pair.from, pair.to, pair.weight);
  const RegistrationSolution of_squares = sums.solve();
  if (!of_squares.usable()) return of_squares;
  const Centred points(problem.pairs);
  if (!std::isfinite(points.weight)) return {};

  // Least squares may leave the rotation open also where points are distinct (a mirrored square).
  bool turns = points.from_distinct && points.to_distinct && points.radius > 0.0;
  if (problem.is_square()) turns = of_squares.status == Status::converged;
  Descended end;
  int evaluations = 0;
  if (turns) {
    const Transform2 first{of_squares.T_to_from.cosine, of_squares.T_to_from.sine,
                           Vector2d::Zero()};
    end = lowest<3>(*solver_, points, first, problem);
    evaluations = end.solution.evaluations;
    turns = !end.solution.usable() || end.rotation_fixed;
  }
  if (!turns) {
    end = lowest<2>(*solver_, points, {}, problem);
    evaluations += end.solution.evaluations;
  }

  RegistrationSolution solution;
  solution.status = status_of(end.solution, turns);
  solution.evaluations = evaluations;
  if (!solution.usable()) return solution;
  solution.T_to_from = end.motion;
  solution.T_to_from.translation += points.to_mean - end.motion.rotate(points.from_mean);
  solution.cost = points.weight * end.solution.cost;
  return solution;
}

std::optional<std::string> RegistrationByDescent::refuses(
    const RegistrationProblem& problem) const {
  const PointPair specimen[2] = {{{0, 0}, {0, 0}}, {{1, 0}, {1, 0}}};
  return solver_->refuses(pose<3>(Centred(specimen), {}, problem.loss));
}

}  // namespace shoal::solvers
