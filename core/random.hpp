#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace shoal {

/// What a random number is for. Numbers of different purposes never depend on one another.
///
/// Those of shoal are numbered; one of your own is the hash of its name:
///
///     inline constexpr Purpose surfacing("my_surfacing");
class Purpose {
 public:
  constexpr explicit Purpose(std::string_view name) : number_(hash(name) | own) {}

  constexpr explicit Purpose(std::uint32_t number) : number_(number) {}

  constexpr std::uint32_t number() const { return number_; }

  static const Purpose start, heading, range_and_bearing, elevation, ping_loss, node_loss, solver,
      bootstrap, sign_flip, design, sensor_state, sensor_noise, process_noise;

 private:
  static constexpr std::uint32_t own = 1u << 31;  // no number of shoal's has this bit

  /// FNV-1a (Fowler, Noll and Vo).
  static constexpr std::uint32_t hash(std::string_view name) {
    std::uint32_t hash = 2166136261u;
    for (const char letter : name) hash = (hash ^ static_cast<unsigned char>(letter)) * 16777619u;
    return hash;
  }

  std::uint32_t number_;
};

// A number that changes is another stream: other numbers in every trial.
inline constexpr Purpose Purpose::start{0u}, Purpose::heading{1u}, Purpose::range_and_bearing{2u},
    Purpose::elevation{3u}, Purpose::ping_loss{4u}, Purpose::node_loss{5u}, Purpose::solver{6u},
    Purpose::bootstrap{7u}, Purpose::sign_flip{8u}, Purpose::design{9u}, Purpose::sensor_state{10u},
    Purpose::sensor_noise{11u}, Purpose::process_noise{12u};

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
