#include "shoal/solvers/autodiff.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace shoal::solvers {
namespace {

// f = x^3 y + exp(y) / x
struct Mixed {
  template <class T>
  T operator()(const T* p) const {
    using std::exp;
    return p[0] * p[0] * p[0] * p[1] + exp(p[1]) / p[0];
  }
};

struct Cubic {
  template <class T>
  T operator()(const T* p) const {
    return p[0] * p[1] * p[2] + p[2] * p[2];
  }
};

// Larger than what a Problem holds in place.
struct Bulky {
  std::array<double, 100> shift{};
  template <class T>
  T operator()(const T* p) const {
    return (p[0] - shift[99]) * (p[0] - shift[99]);
  }
};

TEST(Autodiff, GivesTheGradientAndHessianOneComputesByHand) {
  const Problem problem(Eigen::Vector2d(0, 0), differentiated<2>(Mixed{}));
  const double x = 2.0, y = 0.5, e = std::exp(0.5);
  const std::array at{x, y};
  std::array<double, 2> gradient;
  std::array<double, 4> hessian;
  const double value = problem.evaluate(at.data(), gradient.data(), hessian.data());
  EXPECT_NEAR(value, x * x * x * y + e / x, 1e-14);
  EXPECT_NEAR(gradient[0], 3 * x * x * y - e / (x * x), 1e-14);
  EXPECT_NEAR(gradient[1], x * x * x + e / x, 1e-14);
  EXPECT_NEAR(hessian[0], 6 * x * y + 2 * e / (x * x * x), 1e-13);
  EXPECT_NEAR(hessian[1], 3 * x * x - e / (x * x), 1e-13);
  EXPECT_NEAR(hessian[2], hessian[1], 1e-14);
  EXPECT_NEAR(hessian[3], e / x, 1e-14);
}

TEST(Autodiff, GivesTheSameValueWhateverElseIsWanted) {
  const Problem problem(Eigen::Vector3d(0, 0, 0), differentiated<3>(Cubic{}));
  const std::array at{1.5, -2.0, 3.0};
  std::array<double, 3> gradient, again;
  std::array<double, 9> hessian;
  EXPECT_EQ(problem.evaluate(at.data()), 0.0);
  EXPECT_EQ(problem.evaluate(at.data(), gradient.data()), 0.0);
  EXPECT_EQ(problem.evaluate(at.data(), again.data(), hessian.data()), 0.0);
  EXPECT_EQ(problem.evaluate(at.data(), nullptr, hessian.data()), 0.0);
  EXPECT_EQ(gradient, again);
  EXPECT_EQ(gradient, (std::array{-6.0, 4.5, 3.0}));
  EXPECT_EQ(hessian, (std::array{0.0, 3.0, -2.0, 3.0, 0.0, 1.5, -2.0, 1.5, 2.0}));
}

TEST(Problem, IsCopiedWithItsCostWhetherHeldInPlaceOrNot) {
  Bulky bulky;
  bulky.shift[99] = 4.0;
  const Eigen::Matrix<double, 1, 1> start(1.0);
  Problem large(start, differentiated<1>(bulky));
  large.lower = start;
  large.upper = start;
  large.best_known = 0.0;
  Problem small(Eigen::Vector2d(3, 3), differentiated<2>(Mixed{}));

  const Problem copy = large;
  EXPECT_EQ(copy.evaluate(start.data()), 9.0);
  EXPECT_EQ(copy.best_known, 0.0);
  EXPECT_EQ((*copy.lower)[0], 1.0);

  small = large;
  EXPECT_EQ(small.dimension(), 1);
  EXPECT_EQ(small.evaluate(start.data()), 9.0);
  large = Problem(Eigen::Vector2d(3, 3), differentiated<2>(Mixed{}));
  EXPECT_EQ(large.dimension(), 2);
  EXPECT_FALSE(large.lower.has_value());
  large = *&large;
  EXPECT_NEAR(large.evaluate(large.start.data()), 81.0 + std::exp(3.0) / 3.0, 1e-12);
}

}  // namespace
}  // namespace shoal::solvers
