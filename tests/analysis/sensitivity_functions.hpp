#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "shoal/analysis/statistics/design.hpp"
#include "shoal/analysis/statistics/sensitivity/sobol_indices.hpp"

namespace shoal::analysis::test {

/// The cells of a design of continuous factors.
inline Eigen::MatrixXd draw(const std::string& kind, const std::string& count, std::int64_t n,
                            int factors, std::int64_t seed = 1) {
  Setting table;
  assign(table, count, {.value = n});
  assign(table, "seed", {.value = seed});
  return Registry<Design>::instance()
      .make(kind, table, "design." + kind)
      ->cells(std::vector<int>(static_cast<std::size_t>(factors), 0));
}

inline Eigen::MatrixXd saltelli(std::int64_t base_samples, int factors, std::int64_t seed = 1) {
  return draw("saltelli", "base_samples", base_samples, factors, seed);
}

/// With the rows for indices of pairs.
inline Eigen::MatrixXd saltelli_of_pairs(std::int64_t base_samples, int factors) {
  Setting table;
  assign(table, "base_samples", {.value = base_samples});
  assign(table, "second_order", {.value = true});
  return Registry<Design>::instance()
      .make("saltelli", table, "design.saltelli")
      ->cells(std::vector<int>(static_cast<std::size_t>(factors), 0));
}

inline bool covers(const IndexEstimate& estimate, double truth) {
  return estimate.interval && estimate.interval->low <= truth && truth <= estimate.interval->high;
}

/// A function of one cell, whose factors lie in [0, 1].
using Function = std::function<double(const Eigen::RowVectorXd&)>;

inline std::vector<std::optional<double>> answers(const Eigen::MatrixXd& cells, const Function& f) {
  std::vector<std::optional<double>> answers;
  for (const auto& cell : cells.rowwise()) answers.emplace_back(f(cell));
  return answers;
}

/// A function of which the indices are known.
struct Known {
  Function f;
  std::vector<double> first_order, total;
  std::vector<double> pairs;  ///< (1, 2), (1, 3) ... (2, 3) ...
};

/// Ishigami and Homma 1990, of factors from -pi to pi.
inline Known ishigami(double a, double b) {
  constexpr double pi = std::numbers::pi;
  const double v1 = 0.5 * std::pow(1.0 + b * std::pow(pi, 4) / 5.0, 2);
  const double v2 = a * a / 8.0;
  const double v13 = b * b * std::pow(pi, 8) * 8.0 / 225.0;
  const double v = v1 + v2 + v13;
  return {[=](const Eigen::RowVectorXd& u) {
            const Eigen::RowVectorXd x = (2.0 * u.array() - 1.0) * pi;
            return std::sin(x[0]) * (1.0 + b * std::pow(x[2], 4)) + a * std::pow(std::sin(x[1]), 2);
          },
          {v1 / v, v2 / v, 0.0},
          {(v1 + v13) / v, v2 / v, v13 / v},
          {0.0, v13 / v, 0.0}};
}

/// Sobol' g: the product of (|4 x - 2| + a) / (1 + a) (Saltelli and Sobol' 1995).
inline Known sobol_g(const std::vector<double>& a) {
  Known g;
  double v = 1.0;
  for (const double ai : a) v *= 1.0 + 1.0 / (3.0 * (1.0 + ai) * (1.0 + ai));
  v -= 1.0;
  for (const double ai : a) {
    const double vi = 1.0 / (3.0 * (1.0 + ai) * (1.0 + ai));
    g.first_order.push_back(vi / v);
    g.total.push_back(vi * (v + 1.0) / (1.0 + vi) / v);
  }
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = i + 1; j < a.size(); ++j) {
      g.pairs.push_back(g.first_order[i] * g.first_order[j] * v);
    }
  }
  g.f = [a](const Eigen::RowVectorXd& x) {
    double product = 1.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
      product *= (std::abs(4.0 * x[static_cast<Eigen::Index>(i)] - 2.0) + a[i]) / (1.0 + a[i]);
    }
    return product;
  };
  return g;
}

/// c . x. Each index is the square of a coefficient over their sum.
inline Known linear(const std::vector<double>& c) {
  Known known;
  double squares = 0.0;
  for (const double ci : c) squares += ci * ci;
  for (const double ci : c) known.first_order.push_back(ci * ci / squares);
  known.total = known.first_order;
  known.pairs.assign(c.size() * (c.size() - 1) / 2, 0.0);
  known.f = [c](const Eigen::RowVectorXd& x) {
    double sum = 0.0;
    for (std::size_t i = 0; i < c.size(); ++i) sum += c[i] * x[static_cast<Eigen::Index>(i)];
    return sum;
  };
  return known;
}

}  // namespace shoal::analysis::test
