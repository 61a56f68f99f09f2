#include "shoal/analysis/benchmarking/packed_situations.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace shoal::analysis {
namespace {

using formations::Neighbour;
using formations::OwnState;

// A row: slot, number of neighbours, doubles for each of them, own state, neighbours.
constexpr std::size_t head = 3, own_state = 7, without_motion = 4, with_motion = 7;

bool is_plus_zero(double x) {
  return x == 0.0 && !std::signbit(x);
}

/// Whether its pings carried how it moves.
bool moves(const Neighbour& n) {
  return !(is_plus_zero(n.velocity.x()) && is_plus_zero(n.velocity.y()) &&
           is_plus_zero(n.heading_rad));
}

double* put(double* to, const Eigen::Vector2d& v) {
  *to++ = v.x();
  *to++ = v.y();
  return to;
}

double* put(double* to, const OwnState& own) {
  to = put(put(to, own.position), own.velocity);
  *to++ = own.heading_rad;
  *to++ = own.speed_m_s;
  *to++ = own.turn_rate_rad_s;
  return to;
}

}  // namespace

void PackedSituations::add(const formations::Neighbourhood& seen) {
  const std::size_t stride =
      std::ranges::any_of(seen.neighbours, moves) ? with_motion : without_motion;
  const std::size_t length = head + own_state + stride * seen.neighbours.size();
  if (size_ == rooms_.size()) rooms_.push_back(new_room(length));
  Room& room = rooms_[size_++];
  if (room.capacity < length) room = new_room(length + length / 2);

  double* to = room.begin;
  *to++ = seen.own_slot;
  *to++ = static_cast<double>(seen.neighbours.size());
  *to++ = static_cast<double>(stride);
  to = put(to, seen.own);
  for (const Neighbour& n : seen.neighbours) {
    to = put(to, n.position);
    *to++ = n.age_s;
    *to++ = n.slot;
    if (stride == without_motion) continue;
    to = put(to, n.velocity);
    *to++ = n.heading_rad;
  }
}

void PackedSituations::keep_every_second() {
  size_ = (size_ + 1) / 2;
  for (std::size_t k = 1; k < size_; ++k) std::swap(rooms_[k], rooms_[2 * k]);
}

PackedSituations::Room PackedSituations::new_room(std::size_t doubles) {
  if (left_.capacity < doubles) left_.begin = blocks_->take(doubles, left_.capacity);
  const Room room{left_.begin, doubles};
  left_.begin += doubles;
  left_.capacity -= doubles;
  return room;
}

Situation PackedSituations::operator[](std::size_t k) const {
  const double* at = rooms_[k].begin;
  const auto next = [&] { return *at++; };
  const auto next_vector = [&] {
    const double x = next();
    return Eigen::Vector2d(x, next());
  };
  Situation situation;
  situation.own_slot = static_cast<int>(next());
  const auto count = static_cast<std::size_t>(next()), stride = static_cast<std::size_t>(next());
  situation.own.position = next_vector();
  situation.own.velocity = next_vector();
  situation.own.heading_rad = next();
  situation.own.speed_m_s = next();
  situation.own.turn_rate_rad_s = next();
  situation.neighbours.resize(count);
  for (Neighbour& n : situation.neighbours) {
    n.position = next_vector();
    n.age_s = next();
    n.slot = static_cast<int>(next());
    if (stride == without_motion) continue;
    n.velocity = next_vector();
    n.heading_rad = next();
  }
  return situation;
}

}  // namespace shoal::analysis
