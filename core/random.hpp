#pragma once

#include <array>
#include <cstdint>

namespace shoal {

/// What a random number is for. Numbers of different purposes never depend on one another.
enum class Purpose : std::uint32_t {
  start,
  heading,
  range_and_bearing,
  elevation,
  ping_loss,
  node_loss,
  solver,
  bootstrap,
  sign_flip,
  design,
  sensor_state,
  sensor_noise,
  process_noise,
};

/// Counter-based random numbers (Philox4x32-10): the n-th number of a stream is a pure function of
/// (seed, purpose, vehicle, index). Adding a vehicle, a thread or a shard changes no other stream,
/// and two behaviours under one seed meet the same starts, noise and losses.
class RandomStreams {
 public:
  explicit RandomStreams(std::uint64_t seed) : seed_(seed) {}

  /// 128 independent random bits.
  std::array<std::uint64_t, 2> bits(Purpose purpose, std::uint32_t vehicle,
                                    std::uint64_t index) const;

  /// Two independent numbers, uniform in [0, 1).
  std::array<double, 2> uniform(Purpose purpose, std::uint32_t vehicle, std::uint64_t index) const;

  /// Two independent standard normal numbers.
  std::array<double, 2> normal(Purpose purpose, std::uint32_t vehicle, std::uint64_t index) const;

 private:
  std::uint64_t seed_;
};

}  // namespace shoal
