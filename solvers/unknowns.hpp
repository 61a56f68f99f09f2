#pragma once

#include <Eigen/Core>
#include <memory>
#include <new>
#include <utility>

namespace shoal::solvers {

/// A vector of any number of unknowns. Up to `in_place` are held in the object itself, so that
/// small problems of a control loop do not allocate. Takes and gives all that an Eigen vector does.
class Unknowns : public Eigen::Map<Eigen::VectorXd> {
 public:
  using Base = Eigen::Map<Eigen::VectorXd>;
  static constexpr int in_place = 6;

  Unknowns() : Base(small_, 0) {}
  explicit Unknowns(Eigen::Index size) : Base(small_, 0) { resize(size); }
  Unknowns(const Unknowns& other) : Base(small_, 0) { *this = other; }
  Unknowns(Unknowns&& other) noexcept : Base(small_, 0) { *this = std::move(other); }
  template <class Derived>
  Unknowns(const Eigen::DenseBase<Derived>& other) : Base(small_, 0) {  // NOLINT: as Eigen's own
    *this = other;
  }
  ~Unknowns() = default;

  Unknowns& operator=(const Unknowns& other) {
    if (this == &other) return *this;
    resize(other.size());
    Base::operator=(static_cast<const Base&>(other));
    return *this;
  }
  Unknowns& operator=(Unknowns&& other) noexcept {
    if (this == &other) return *this;
    if (!other.large_) return *this = std::as_const(other);
    large_ = std::move(other.large_);
    point_to(large_.get(), other.size());
    other.point_to(other.small_, 0);
    return *this;
  }
  template <class Derived>
  Unknowns& operator=(const Eigen::DenseBase<Derived>& other) {
    // An expression of another size cannot hold these elements.
    if (other.size() != size()) resize(other.size());
    Base::operator=(other.derived());
    return *this;
  }

  /// The elements are lost unless the size stays.
  void resize(Eigen::Index size) {
    if (size == this->size()) return;
    large_ = size > in_place ? std::make_unique<double[]>(static_cast<std::size_t>(size)) : nullptr;
    point_to(large_ ? large_.get() : small_, size);
  }

 private:
  // How Eigen has a Map point elsewhere.
  void point_to(double* elements, Eigen::Index size) {
    new (static_cast<Base*>(this)) Base(elements, size);
  }

  alignas(16) double small_[in_place];
  std::unique_ptr<double[]> large_;
};

}  // namespace shoal::solvers
