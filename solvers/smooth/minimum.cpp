#include "shoal/solvers/smooth/minimum.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <vector>

namespace shoal::solvers {
namespace {

constexpr double slack = 10.0;  // the backends bound their last step, not the error
using Vector = Problem::Vector;
using Columns = Eigen::MatrixXd;

/// The constraints that are active at x: bounds it lies on, constraints that are about zero, and
/// both sides of equalities.
struct ActiveSet {
  /// Behind a column: a function and its block, or none for a bound.
  struct Source {
    const VectorFunction* function = nullptr;
    int block = 0;
    double sign = 1.0;
  };
  Columns normals;  // of the feasible side, one a column
  std::vector<Source> sources;

  void add(const Eigen::VectorXd& normal, const Source& source) {
    normals.conservativeResize(normal.size(), normals.cols() + 1);
    normals.col(normals.cols() - 1) = source.sign * normal;
    sources.push_back(source);
  }
};

ActiveSet active_set_at(const Problem& problem, const Vector& x, double reach) {
  ActiveSet found;
  const Eigen::Index n = x.size();
  found.normals.resize(n, 0);
  for (Eigen::Index i = 0; problem.lower && i < n; ++i) {
    if (x[i] - (*problem.lower)[i] <= reach) found.add(Eigen::VectorXd::Unit(n, i), {});
    if ((*problem.upper)[i] - x[i] <= reach) found.add(-Eigen::VectorXd::Unit(n, i), {});
  }
  const auto visit = [&](const VectorFunction* function, auto consider) {
    for (int k = 0; function && k < function->blocks(); ++k) {
      double value = 0.0;
      Eigen::VectorXd normal(n);
      evaluate_by_all(*function, k, static_cast<int>(n), x.data(), &value, normal.data(), nullptr);
      consider(k, value, normal);
    }
  };
  visit(problem.constraints.get(), [&](int k, double value, const Eigen::VectorXd& normal) {
    if (value <= reach * normal.norm()) found.add(normal, {problem.constraints.get(), k});
  });
  visit(problem.equalities.get(), [&](int k, double, const Eigen::VectorXd& normal) {
    for (const double sign : {1.0, -1.0}) found.add(normal, {problem.equalities.get(), k, sign});
  });
  return found;
}

/// The multipliers (at least zero) that leave the least of the gradient: Lawson and Hanson 1974,
/// Solving least squares problems, ch. 23.
Eigen::VectorXd multipliers(const Columns& normals, const Eigen::VectorXd& gradient) {
  const Eigen::Index count = normals.cols();
  Eigen::VectorXd best = Eigen::VectorXd::Zero(count);
  std::vector<Eigen::Index> used;
  const double rounding = 1e-12 * gradient.norm();
  for (Eigen::Index round = 0; round < 3 * count; ++round) {
    const Eigen::VectorXd gain = normals.transpose() * (gradient - normals * best);
    Eigen::Index next = -1;
    for (Eigen::Index k = 0; k < count; ++k) {
      if (std::ranges::find(used, k) != used.end()) continue;
      if (gain[k] > rounding * normals.col(k).norm() && (next < 0 || gain[k] > gain[next]))
        next = k;
    }
    if (next < 0) break;
    used.push_back(next);
    while (!used.empty()) {
      const Eigen::MatrixXd part = normals(Eigen::all, used);
      const Eigen::VectorXd fit = part.completeOrthogonalDecomposition().solve(gradient);
      if (fit.minCoeff() > 0.0) {
        best.setZero();
        for (std::size_t k = 0; k < used.size(); ++k)
          best[used[k]] = fit[static_cast<Eigen::Index>(k)];
        break;
      }
      double share = 1.0;  // as far towards the fit as all stay at least zero
      for (std::size_t k = 0; k < used.size(); ++k) {
        const double to = fit[static_cast<Eigen::Index>(k)];
        const double from = best[used[k]];
        if (to <= 0.0) share = std::min(share, from > to ? from / (from - to) : 0.0);
      }
      for (std::size_t k = 0; k < used.size(); ++k) {
        double& value = best[used[k]];
        value += share * (fit[static_cast<Eigen::Index>(k)] - value);
      }
      std::erase_if(used, [&](Eigen::Index k) {
        const bool out = best[k] <= 1e-300;
        if (out) best[k] = 0.0;
        return out;
      });
    }
  }
  return best;
}

/// Of N unknowns, or of any number up to Max.
template <int N, int Max>
using Part = Eigen::Matrix<double, N, 1, 0, Max, 1>;
template <int N, int Max>
using Square = Eigen::Matrix<double, N, N, 0, Max, Max>;

/// Whether Newton's step is short, and nothing leads down from here. Directions without curvature
/// have no such step: there the gradient must be negligible.
template <int N, int Max>
bool lowest_around(const Part<N, Max>& gradient, const Square<N, Max>& hessian, double longest,
                   double largest_gradient) {
  constexpr double flat = 1e-6;
  const Eigen::LLT<Square<N, Max>> factor(hessian);  // the usual case, and fast
  if (factor.info() == Eigen::Success) {
    const Part<N, Max> step = factor.solve(gradient);
    if (step.norm() <= longest) return true;
  }
  const Eigen::SelfAdjointEigenSolver<Square<N, Max>> eigen(hessian);
  const Part<N, Max>& eigenvalues = eigen.eigenvalues();
  const Part<N, Max> along = eigen.eigenvectors().transpose() * gradient;
  const double largest = eigenvalues.cwiseAbs().maxCoeff();
  double squared = 0.0;
  for (Eigen::Index i = 0; i < eigenvalues.size(); ++i) {
    if (eigenvalues[i] < -negligible_curvature * largest) return false;
    if (eigenvalues[i] > curvature_of_rounding * largest) {
      squared += along[i] * along[i] / (eigenvalues[i] * eigenvalues[i]);
    } else if (std::abs(along[i]) > flat * largest_gradient) {
      return false;
    }
  }
  return std::sqrt(squared) <= longest;
}

/// Of at most Max unknowns.
template <int Max>
bool is_minimum(const Problem& problem, const Vector& x, double longest, double largest_gradient) {
  constexpr int N = Eigen::Dynamic;
  Part<N, Max> gradient(x.size());
  Square<N, Max> hessian(x.size(), x.size());
  problem.evaluate(x.data(), gradient.data(), hessian.data());
  if (!gradient.allFinite() || !hessian.allFinite()) return false;
  if (!problem.lower && !problem.constrained()) {
    switch (x.size()) {  // the usual case at every ping
      case 2:
        return lowest_around<2, 2>(gradient, hessian, longest, largest_gradient);
      case 3:
        return lowest_around<3, 3>(gradient, hessian, longest, largest_gradient);
      default:
        return lowest_around<N, Max>(gradient, hessian, longest, largest_gradient);
    }
  }

  const ActiveSet active = active_set_at(problem, x, longest);
  const Eigen::VectorXd multiplier = multipliers(active.normals, gradient);
  std::vector<Eigen::Index> binding;
  for (Eigen::Index k = 0; k < multiplier.size(); ++k) {
    if (!(multiplier[k] > 0.0)) continue;
    binding.push_back(k);
    gradient -= multiplier[k] * active.normals.col(k);
    const ActiveSet::Source& source = active.sources[static_cast<std::size_t>(k)];
    if (!source.function || source.function->linear()) continue;
    double value = 0.0;
    Square<N, Max> constraint_hessian(x.size(), x.size());
    evaluate_by_all(*source.function, source.block, static_cast<int>(x.size()), x.data(), &value,
                    nullptr, constraint_hessian.data());
    hessian -= multiplier[k] * source.sign * constraint_hessian;
  }
  // Equalities hold it back also where nothing presses against them.
  for (Eigen::Index k = 0; k < multiplier.size(); ++k) {
    const bool equal =
        active.sources[static_cast<std::size_t>(k)].function == problem.equalities.get();
    if (problem.equalities && equal && !(multiplier[k] > 0.0)) binding.push_back(k);
  }
  if (binding.empty()) return lowest_around<N, Max>(gradient, hessian, longest, largest_gradient);
  const Eigen::MatrixXd held = active.normals(Eigen::all, binding);
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(held);
  const Eigen::MatrixXd basis = qr.householderQ() * Eigen::MatrixXd::Identity(x.size(), x.size());
  const Eigen::MatrixXd surface = basis.rightCols(x.size() - qr.rank());
  if (surface.cols() == 0) return true;  // held in every direction
  return lowest_around<N, Max>(surface.transpose() * gradient,
                               surface.transpose() * hessian * surface, longest, largest_gradient);
}

}  // namespace

double bounds_violation(const Problem& problem, const Eigen::Ref<const Eigen::VectorXd>& x) {
  if (!problem.lower) return 0.0;
  return std::max({0.0, (*problem.lower - x).maxCoeff(), (x - *problem.upper).maxCoeff()});
}

double constraint_violation(const Problem& problem, const Eigen::Ref<const Eigen::VectorXd>& x) {
  double worst = 0.0;
  for (int k = 0; problem.constraints && k < problem.constraints->blocks(); ++k) {
    double value = 0.0;
    problem.constraints->evaluate(k, x.data(), &value, nullptr, nullptr);
    if (!(value >= -worst)) worst = -value;  // NaN, too
  }
  for (int k = 0; problem.equalities && k < problem.equalities->blocks(); ++k) {
    double value = 0.0;
    problem.equalities->evaluate(k, x.data(), &value, nullptr, nullptr);
    if (!(std::abs(value) <= worst)) worst = std::abs(value);
  }
  return worst;
}

bool is_local_minimum(const Problem& problem, const Vector& x, double x_tolerance_m,
                      double largest_gradient) {
  const double longest = slack * x_tolerance_m;
  constexpr int few = Unknowns::in_place;
  return x.size() <= few ? is_minimum<few>(problem, x, longest, largest_gradient)
                         : is_minimum<Eigen::Dynamic>(problem, x, longest, largest_gradient);
}

}  // namespace shoal::solvers
