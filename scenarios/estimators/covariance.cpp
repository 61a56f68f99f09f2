#include "shoal/scenarios/estimators/covariance.hpp"

#include <Eigen/Eigenvalues>

namespace shoal::scenarios {

bool lift_eigenvalues(AnyCovariance& P) {
  using Vector =
      Eigen::Matrix<double, Eigen::Dynamic, 1, 0, AnyCovariance::MaxRowsAtCompileTime, 1>;
  if (!P.allFinite()) return false;
  // Variances of metres and of radians are put on one scale first.
  const Vector sd = P.diagonal().unaryExpr(
      [](double variance) { return variance != 0.0 ? std::sqrt(std::abs(variance)) : 1.0; });
  const Vector per_sd = sd.cwiseInverse();
  const AnyCovariance correlation = per_sd.asDiagonal() * P * per_sd.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<AnyCovariance> solved(correlation);
  if (solved.info() != Eigen::Success) return false;
  const AnyCovariance scaled = sd.asDiagonal() * solved.eigenvectors();
  P = scaled * solved.eigenvalues().cwiseMax(1e-9).asDiagonal() * scaled.transpose();
  P = 0.5 * (P + P.transpose()).eval();
  return true;
}

void refuse_indefinite(const AnyCovariance& P, const std::string& name) {
  const Eigen::SelfAdjointEigenSolver<AnyCovariance> solved(P, Eigen::EigenvaluesOnly);
  throw InputError(name + " is not positive semidefinite: its smallest eigenvalue is " +
                   std::to_string(solved.eigenvalues()(0)) +
                   "; check that no correlation exceeds 1");
}

}  // namespace shoal::scenarios
