#include "shoal/core/random.hpp"

#include <Random123/philox.h>

#include <cmath>
#include <numbers>

namespace shoal {

std::array<std::uint64_t, 2> RandomStreams::bits(Purpose purpose, std::uint32_t vehicle,
                                                 std::uint64_t index) const {
  using Generator = r123::Philox4x32;
  const auto low = [](std::uint64_t word) { return static_cast<std::uint32_t>(word); };
  const auto high = [](std::uint64_t word) { return static_cast<std::uint32_t>(word >> 32); };
  const Generator::ctr_type counter{{low(index), high(index), vehicle, purpose.number()}};
  const Generator::key_type key{{low(seed_), high(seed_)}};
  const Generator::ctr_type words = Generator{}(counter, key);
  const auto joined = [](std::uint32_t a, std::uint32_t b) {
    return (static_cast<std::uint64_t>(a) << 32) | b;
  };
  return {joined(words[0], words[1]), joined(words[2], words[3])};
}

std::array<double, 2> RandomStreams::uniform(Purpose purpose, std::uint32_t vehicle,
                                             std::uint64_t index) const {
  // The upper 53 of 64 bits, so that every value is exact and below one.
  const auto unit = [](std::uint64_t word) { return static_cast<double>(word >> 11) * 0x1p-53; };
  const auto [first, second] = bits(purpose, vehicle, index);
  return {unit(first), unit(second)};
}

std::array<double, 2> RandomStreams::normal(Purpose purpose, std::uint32_t vehicle,
                                            std::uint64_t index) const {
  // Box and Muller 1958; 1 - u lies in (0, 1], so the logarithm is finite.
  const auto [u, angle] = uniform(purpose, vehicle, index);
  const double radius = std::sqrt(-2.0 * std::log(1.0 - u));
  const double theta = 2.0 * std::numbers::pi * angle;
  return {radius * std::cos(theta), radius * std::sin(theta)};
}

}  // namespace shoal
