#include "shoal/analysis/experiments/measures/energy_linearity.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "shoal/analysis/experiments/measure.hpp"

namespace shoal::analysis {
namespace {

double mean(std::span<const double> numbers) {
  return std::accumulate(numbers.begin(), numbers.end(), 0.0) / static_cast<double>(numbers.size());
}

/// How near linear in time the energy is (Rypkema 2015, sec. 5.2.1): the mean over the vehicles
/// that are left, as the measure of energy keeps it.
class EnergyLinearity final : public Measure {
 public:
  static void declare(Options<EnergyLinearity>&) {}

  std::vector<Quantity> values() const override {
    return {{"energy_nonlinearity", "",
             "greatest deviation of the mean energy from a straight line over time / energy at the "
             "end"}};
  }

  void finish(const scenarios::World&, Results& results) const override {
    const scenarios::Series& energy = results.earlier_series("energy_mean_wh");
    results.add("energy_nonlinearity", nonlinearity(energy.time_s, energy.values));
  }
};

const Register<Measure, EnergyLinearity> registered{"energy_linearity",
                                                    "how near linear in time the energy is"};

}  // namespace

std::optional<double> nonlinearity(std::span<const double> time_s,
                                   std::span<const double> numbers) {
  if (numbers.size() < 3 || numbers.back() == 0.0) return std::nullopt;
  const double t = mean(time_s), y = mean(numbers);
  double rise = 0.0, width = 0.0;
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    rise += (time_s[k] - t) * (numbers[k] - y);
    width += (time_s[k] - t) * (time_s[k] - t);
  }
  double greatest = 0.0;
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    const double line = y + rise / width * (time_s[k] - t);
    greatest = std::max(greatest, std::abs(numbers[k] - line));
  }
  return greatest / std::abs(numbers.back());
}

}  // namespace shoal::analysis
