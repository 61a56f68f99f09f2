#pragma once

#include <Eigen/Core>
#include <cmath>

namespace shoal::solvers {

/// A number that carries its gradient and Hessian with respect to N unknowns.
///
/// Costs templated on their scalar are differentiated exactly by evaluating them on it. (Dual
/// numbers of dual numbers, ceres::Jet<ceres::Jet<...>>, would do the same, but refuse products
/// with plain numbers, so that `2.0 * x` would not compile in a user's cost.)
template <int N>
struct Taylor {
  using Gradient = Eigen::Matrix<double, N, 1>;
  using Hessian = Eigen::Matrix<double, N, N>;

  double value = 0.0;
  Gradient gradient = Gradient::Zero();
  Hessian hessian = Hessian::Zero();

  Taylor() = default;
  Taylor(double constant) : value(constant) {}  // NOLINT: plain numbers are constants
  Taylor(double v, const Gradient& g, const Hessian& h) : value(v), gradient(g), hessian(h) {}

  static Taylor unknown(double v, int index) {
    Taylor x(v);
    x.gradient[index] = 1.0;
    return x;
  }

  /// f(*this), given f and its first two derivatives at the value.
  Taylor chained(double f, double df, double d2f) const {
    return {f, df * gradient, df * hessian + d2f * gradient * gradient.transpose()};
  }

  Taylor operator-() const { return {-value, -gradient, -hessian}; }
  friend Taylor operator+(const Taylor& a, const Taylor& b) {
    return {a.value + b.value, a.gradient + b.gradient, a.hessian + b.hessian};
  }
  friend Taylor operator-(const Taylor& a, const Taylor& b) { return a + (-b); }
  friend Taylor operator*(const Taylor& a, const Taylor& b) {
    const Hessian cross = a.gradient * b.gradient.transpose();
    return {a.value * b.value, a.value * b.gradient + b.value * a.gradient,
            a.value * b.hessian + b.value * a.hessian + cross + cross.transpose()};
  }
  friend Taylor operator/(const Taylor& a, const Taylor& b) {
    const double inverse = 1.0 / b.value;
    return a * b.chained(inverse, -inverse * inverse, 2.0 * inverse * inverse * inverse);
  }
  Taylor& operator+=(const Taylor& b) { return *this = *this + b; }
  Taylor& operator-=(const Taylor& b) { return *this = *this - b; }
  Taylor& operator*=(const Taylor& b) { return *this = *this * b; }
  Taylor& operator/=(const Taylor& b) { return *this = *this / b; }

  // Comparisons are of the values, so that costs may branch.
  friend bool operator<(const Taylor& a, const Taylor& b) { return a.value < b.value; }
  friend bool operator>(const Taylor& a, const Taylor& b) { return a.value > b.value; }
  friend bool operator<=(const Taylor& a, const Taylor& b) { return a.value <= b.value; }
  friend bool operator>=(const Taylor& a, const Taylor& b) { return a.value >= b.value; }

  friend Taylor sqrt(const Taylor& x) {
    const double root = std::sqrt(x.value);
    return x.chained(root, 0.5 / root, -0.25 / (root * x.value));
  }
  friend Taylor exp(const Taylor& x) {
    const double e = std::exp(x.value);
    return x.chained(e, e, e);
  }
  friend Taylor log(const Taylor& x) {
    return x.chained(std::log(x.value), 1.0 / x.value, -1.0 / (x.value * x.value));
  }
  friend Taylor pow(const Taylor& x, double p) {
    return x.chained(std::pow(x.value, p), p * std::pow(x.value, p - 1.0),
                     p * (p - 1.0) * std::pow(x.value, p - 2.0));
  }
  friend Taylor sin(const Taylor& x) {
    return x.chained(std::sin(x.value), std::cos(x.value), -std::sin(x.value));
  }
  friend Taylor cos(const Taylor& x) {
    return x.chained(std::cos(x.value), -std::sin(x.value), -std::cos(x.value));
  }
  friend Taylor atan(const Taylor& x) {
    const double d = 1.0 / (1.0 + x.value * x.value);
    return x.chained(std::atan(x.value), d, -2.0 * x.value * d * d);
  }
  friend Taylor tanh(const Taylor& x) {
    const double t = std::tanh(x.value);
    return x.chained(t, 1.0 - t * t, -2.0 * t * (1.0 - t * t));
  }
  friend Taylor abs(const Taylor& x) { return x.value < 0.0 ? -x : x; }
};

}  // namespace shoal::solvers
