#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

namespace shoal::analysis {

/// How far vehicles were from the slots that they hold in the end, at each instant of a mission:
/// the slots are laid onto the vehicles anew each time (least squares), and each vehicle keeps its
/// own.
class SlotKeeping {
 public:
  /// `slots`: of each vehicle, m. `places`: of the same vehicles, instant after instant, m.
  SlotKeeping(std::span<const Eigen::Vector2d> slots, std::span<const Eigen::Vector2f> places);

  std::size_t vehicles() const { return vehicles_; }
  std::size_t instants() const { return off_m_.size() / vehicles_; }
  double off_m(std::size_t instant, std::size_t vehicle) const {
    return off_m_[instant * vehicles_ + vehicle];
  }
  double mean_m(std::size_t instant) const;

  /// The vehicles that held another slot at an instant: half a spacing away and more.
  std::vector<std::size_t> elsewhere(std::size_t instant, double spacing_m) const;

 private:
  std::size_t vehicles_;
  std::vector<double> off_m_;
};

}  // namespace shoal::analysis
