#include <cmath>

#include "shoal/formations/plan.hpp"

namespace shoal::formations {
namespace {

// Places of the author's lattices, in units of the separation (Rypkema 2015, sec. 4.2; rows run
// south in the square one and north in the hexagonal one, as in his launch scripts).
Eigen::Vector2d square_place(double column, double row) {
  return {column, -row};
}
Eigen::Vector2d hexagonal_place(double column, double row) {
  return {column + 0.5 * std::fmod(row, 2.0), row * std::sqrt(3.0) / 2.0};
}

/// A lattice of rows x columns, named NODE_1, NODE_2 ... column by column.
template <Eigen::Vector2d (*place)(double column, double row)>
struct Lattice final : PlanSource {
  std::int64_t rows = 5;
  std::int64_t columns = 4;
  double separation_m = 300.0;
  Origin origin;

  static void declare(Options<Lattice>& o) {
    o.integer("rows", &Lattice::rows, "", in(1, 1000), "lattice positions along y");
    o.integer("columns", &Lattice::columns, "", in(1, 1000), "lattice positions along x");
    o.number("separation_m", &Lattice::separation_m, "m", above(0),
             "distance to the nearest lattice positions");
  }

  Plan plan() const override { return padded(0); }

  Plan padded(int layers) const override {
    if (layers < 0 || layers > most_layers) {
      throw InputError(origin, "a lattice cannot be padded by " + std::to_string(layers) +
                                   " layers; give 0 to " + std::to_string(most_layers));
    }
    const std::int64_t more = std::int64_t{2} * layers;
    const std::int64_t padded_rows = rows + more;
    const std::int64_t padded_columns = columns + more;
    constexpr std::int64_t most_slots = 100'000;
    if (padded_rows * padded_columns > most_slots) {
      throw InputError(origin, "a lattice of " + std::to_string(padded_rows) + " x " +
                                   std::to_string(padded_columns) + " has " +
                                   std::to_string(padded_rows * padded_columns) +
                                   " slots, and may have " + std::to_string(most_slots) +
                                   "; take fewer rows, columns or layers");
    }
    std::vector<std::string> names;
    std::vector<Eigen::Vector2d> slots;
    for (std::int64_t column = 0; column < padded_columns; ++column) {
      for (std::int64_t row = 0; row < padded_rows; ++row) {
        names.push_back("NODE_" + std::to_string(names.size() + 1));
        slots.push_back(separation_m *
                        place(static_cast<double>(column), static_cast<double>(row)));
      }
    }
    return Plan(std::move(names), std::move(slots), origin).centred();
  }
};

const Register<PlanSource, Lattice<square_place>> square{
    "square", "a square lattice (Rypkema 2015, sec. 4.2)"};
const Register<PlanSource, Lattice<hexagonal_place>> hexagonal{
    "hexagonal", "a lattice of equilateral triangles (Rypkema 2015, sec. 4.2)"};

}  // namespace
}  // namespace shoal::formations
