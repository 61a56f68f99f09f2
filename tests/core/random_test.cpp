#include "shoal/core/random.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

namespace shoal {
namespace {

constexpr int draws = 50'000;  // of two numbers each

template <class Draw>
std::vector<double> sample(Draw draw) {
  std::vector<double> numbers;
  for (std::uint64_t i = 0; i < draws; ++i) {
    for (const double x : draw(i)) numbers.push_back(x);
  }
  return numbers;
}

std::vector<double> uniforms() {
  const RandomStreams streams(1);
  return sample([&](std::uint64_t i) { return streams.uniform(Purpose::start, 3, i); });
}

std::vector<double> normals() {
  const RandomStreams streams(1);
  return sample([&](std::uint64_t i) { return streams.normal(Purpose::start, 3, i); });
}

double mean(const std::vector<double>& x) {
  double sum = 0.0;
  for (const double value : x) sum += value;
  return sum / static_cast<double>(x.size());
}

double variance(const std::vector<double>& x) {
  const double centre = mean(x);
  double sum = 0.0;
  for (const double value : x) sum += (value - centre) * (value - centre);
  return sum / static_cast<double>(x.size());
}

/// Kolmogorov-Smirnov statistic times sqrt(n); below 1.95 with probability 0.999.
template <class Distribution>
double kolmogorov(std::vector<double> x, Distribution below) {
  std::ranges::sort(x);
  const auto n = static_cast<double>(x.size());
  double largest = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double p = below(x[i]);
    const auto rank = static_cast<double>(i);
    largest = std::max({largest, p - rank / n, (rank + 1) / n - p});
  }
  return largest * std::sqrt(n);
}

double from_words(std::uint64_t high, std::uint64_t low) {
  return std::ldexp(static_cast<double>(((high << 32) | low) >> 11), -53);
}

TEST(RandomStreams, GiveThePublishedPhiloxNumbers) {
  // Philox4x32-10 test vectors of Salmon et al. 2011 (kat_vectors of Random123).
  const auto zero = RandomStreams(0).uniform(Purpose{0}, 0, 0);
  EXPECT_EQ(zero[0], from_words(0x6627e8d5, 0xe169c58d));
  EXPECT_EQ(zero[1], from_words(0xbc57ac4c, 0x9b00dbd8));
  const auto ones = RandomStreams(~0ull).uniform(Purpose{~0u}, ~0u, ~0ull);
  EXPECT_EQ(ones[0], from_words(0x408f276d, 0x41c83b0e));
  EXPECT_EQ(ones[1], from_words(0xa20bc7c6, 0x6d5451fd));
  const auto of_pi = RandomStreams(0x299f31d0a4093822)
                         .uniform(Purpose{0x03707344}, 0x13198a2e, 0x85a308d3243f6a88);
  EXPECT_EQ(of_pi[0], from_words(0xd16cfe09, 0x94fdcceb));
  EXPECT_EQ(of_pi[1], from_words(0x5001e420, 0x24126ea1));
}

TEST(RandomStreams, SameKeyGivesTheSameNumbers) {
  EXPECT_EQ(RandomStreams(7).uniform(Purpose::heading, 2, 9),
            RandomStreams(7).uniform(Purpose::heading, 2, 9));
  EXPECT_EQ(RandomStreams(7).normal(Purpose::heading, 2, 9),
            RandomStreams(7).normal(Purpose::heading, 2, 9));
}

TEST(RandomStreams, EveryPartOfTheKeyMatters) {
  std::set<double> numbers;
  const std::uint64_t high_word = 1ull << 32;
  for (const std::uint64_t seed : {std::uint64_t{0}, std::uint64_t{1}, high_word}) {
    for (const Purpose purpose : {Purpose::start, Purpose::ping_loss}) {
      for (const std::uint32_t vehicle : {0u, 1u}) {
        for (const std::uint64_t index : {std::uint64_t{0}, std::uint64_t{1}, high_word}) {
          for (const double x : RandomStreams(seed).uniform(purpose, vehicle, index)) {
            numbers.insert(x);
          }
        }
      }
    }
  }
  EXPECT_EQ(numbers.size(), 3u * 2 * 2 * 3 * 2);
}

// The seed is fixed, so these hold or fail for good; bounds are 4 standard errors.

TEST(RandomStreams, UniformsAreUniformAndBelowOne) {
  const std::vector<double> x = uniforms();
  EXPECT_GE(*std::ranges::min_element(x), 0.0);
  EXPECT_LT(*std::ranges::max_element(x), 1.0);
  const auto n = static_cast<double>(x.size());
  EXPECT_NEAR(mean(x), 0.5, 4 * std::sqrt(1.0 / 12 / n));
  EXPECT_NEAR(variance(x), 1.0 / 12, 4 * std::sqrt(1.0 / 180 / n));
  EXPECT_LT(kolmogorov(x, [](double u) { return u; }), 1.95);
}

TEST(RandomStreams, NormalsAreStandardNormal) {
  const std::vector<double> x = normals();
  const auto n = static_cast<double>(x.size());
  EXPECT_NEAR(mean(x), 0.0, 4 / std::sqrt(n));
  EXPECT_NEAR(variance(x), 1.0, 4 * std::sqrt(2.0 / n));
  EXPECT_LT(kolmogorov(x, [](double z) { return 0.5 * std::erfc(-z / std::sqrt(2.0)); }), 1.95);
}

TEST(RandomStreams, TheTwoNumbersOfADrawAreUncorrelated) {
  for (const auto& x : {normals(), uniforms()}) {
    const double centre = mean(x);
    double sum = 0.0;
    for (std::size_t i = 0; i < x.size(); i += 2) sum += (x[i] - centre) * (x[i + 1] - centre);
    EXPECT_LT(std::abs(sum / draws / variance(x)), 4 / std::sqrt(draws));
  }
}

TEST(RandomStreams, PurposesOfYourOwnHaveStreamsOfTheirOwn) {
  constexpr Purpose mine("my_surfacing"), other("my_dive");
  const RandomStreams streams(1);
  EXPECT_EQ(mine.number(), Purpose("my_surfacing").number());
  EXPECT_NE(streams.bits(mine, 0, 0), streams.bits(other, 0, 0));
  for (const Purpose known : {Purpose::start, Purpose::heading, Purpose::process_noise}) {
    EXPECT_NE(streams.bits(mine, 0, 0), streams.bits(known, 0, 0));
  }
}

}  // namespace
}  // namespace shoal
