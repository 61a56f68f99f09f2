#include "shoal/analysis/reporting/packed.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <vector>

namespace shoal::analysis {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::uint16_t no_level = 65535;
constexpr std::int16_t ended = std::numeric_limits<std::int16_t>::min();
constexpr double most_units = 32000.0;

std::string base64(std::span<const std::uint8_t> bytes) {
  static constexpr char digits[] =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t left = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t three = 0;
    for (std::size_t k = 0; k < 3; ++k) three = three << 8 | (k < left ? bytes[i + k] : 0u);
    for (std::size_t k = 0; k < 4; ++k) {
      text += k <= left ? digits[three >> (18 - 6 * k) & 63u] : '=';
    }
  }
  return text;
}

/// Least significant byte first, wherever the page is made.
template <class Word>
std::string base64_of_words(std::span<const Word> words) {
  std::vector<std::uint8_t> bytes;
  bytes.reserve(words.size() * sizeof(Word));
  for (const Word word : words) {
    for (std::size_t k = 0; k < sizeof(Word); ++k) {
      bytes.push_back(static_cast<std::uint8_t>(word >> (8 * k) & 0xffu));
    }
  }
  return base64(bytes);
}

}  // namespace

std::string packed_bytes(std::span<const std::uint8_t> bytes) {
  return base64(bytes);
}

std::string packed_indices(std::span<const std::uint16_t> indices) {
  return base64_of_words(indices);
}

std::string packed_floats(std::span<const double> numbers) {
  std::vector<std::uint32_t> words;
  words.reserve(numbers.size());
  for (const double x : numbers) {
    words.push_back(std::bit_cast<std::uint32_t>(static_cast<float>(x)));
  }
  return base64_of_words(std::span<const std::uint32_t>(words));
}

Json packed_levels(std::span<const double> numbers) {
  double least = std::numeric_limits<double>::infinity(), greatest = -least;
  for (const double x : numbers) {
    if (!std::isfinite(x)) continue;
    least = std::min(least, x);
    greatest = std::max(greatest, x);
  }
  const bool any = least <= greatest;
  const double scale = any ? (greatest - least) / (no_level - 1) : 0.0;
  std::vector<std::uint16_t> levels;
  levels.reserve(numbers.size());
  for (const double x : numbers) {
    const double level = scale > 0.0 ? std::round((x - least) / scale) : 0.0;
    levels.push_back(std::isfinite(x) ? static_cast<std::uint16_t>(level) : no_level);
  }
  return {{"offset", any ? least : 0.0},
          {"scale", scale},
          {"data", base64_of_words(std::span<const std::uint16_t>(levels))}};
}

Json packed_steps(std::span<const double> numbers, std::size_t rows) {
  const std::size_t length = rows > 0 ? numbers.size() / rows : 0;
  double farthest = 0.0;
  for (std::size_t row = 0; row < rows; ++row) {
    for (std::size_t k = row * length + 1; k < (row + 1) * length; ++k) {
      const double step = std::abs(numbers[k] - numbers[k - 1]);
      if (std::isfinite(step)) farthest = std::max(farthest, step);
    }
  }
  const double unit = std::max(0.01, farthest / most_units);

  Json first = Json::array();
  std::vector<std::uint16_t> words;
  words.reserve(numbers.size());
  for (std::size_t row = 0; row < rows; ++row) {
    const double start = length > 0 ? numbers[row * length] : 0.0;
    first.push_back(std::isfinite(start) ? Json(start) : Json(nullptr));
    double before = 0.0;
    bool over = !std::isfinite(start);
    for (std::size_t k = row * length; k < (row + 1) * length; ++k) {
      over = over || !std::isfinite(numbers[k]);
      const double count = over ? 0.0 : std::round((numbers[k] - start) / unit);
      const auto step = over ? ended : static_cast<std::int16_t>(count - before);
      words.push_back(std::bit_cast<std::uint16_t>(step));
      before = count;
    }
  }
  return {{"unit", unit},
          {"first", first},
          {"data", base64_of_words(std::span<const std::uint16_t>(words))}};
}

}  // namespace shoal::analysis
