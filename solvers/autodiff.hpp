#pragma once

#include <Eigen/Core>

#include "shoal/solvers/problem.hpp"
#include "shoal/solvers/taylor.hpp"

namespace shoal::solvers {

/// Makes an objective with exact gradient and Hessian of a cost that is templated on its scalar:
///
///     struct Bowl { template <class T> T operator()(const T* x) const { return x[0]*x[0]; } };
///     Problem problem(start, differentiated<2>(Bowl{}));
///
/// Numbers of fixed size carry the derivatives (taylor.hpp): nothing is allocated.
template <int N, class Cost>
class Differentiated final : public Objective {
 public:
  explicit Differentiated(const Cost& cost) : cost_(cost) {}

  double evaluate(const double* x, double* gradient, double* hessian) const override {
    if (!gradient && !hessian) return cost_(x);
    Taylor<N> unknowns[N];
    for (int i = 0; i < N; ++i) unknowns[i] = Taylor<N>::unknown(x[i], i);
    const Taylor<N> y = cost_(static_cast<const Taylor<N>*>(unknowns));
    if (gradient) Eigen::Map<typename Taylor<N>::Gradient>{gradient} = y.gradient;
    if (hessian) Eigen::Map<typename Taylor<N>::Hessian>{hessian} = y.hessian;
    return y.value;
  }

  std::pair<Objective*, bool> copy_into(void* storage, std::size_t size) const override {
    if (sizeof(*this) <= size && alignof(Differentiated) <= alignof(std::max_align_t)) {
      return {new (storage) Differentiated(*this), false};
    }
    return {new Differentiated(*this), true};
  }

 private:
  Cost cost_;
};

template <int N, class Cost>
Differentiated<N, Cost> differentiated(const Cost& cost) {
  return Differentiated<N, Cost>(cost);
}

}  // namespace shoal::solvers
