#include "shoal/analysis/experiments/evaluations/obstacle_row.hpp"

#include "shoal/analysis/experiments/evaluation.hpp"
#include "shoal/core/text.hpp"
#include "shoal/formations/obstacles/shapes.hpp"

namespace shoal::analysis {

using namespace formations;

std::unique_ptr<Obstacle> obstacle_of(const CsvTable& table, std::size_t row,
                                      const std::string& shape_column,
                                      const std::string& size_column) {
  const std::string& shape = table.text(row, shape_column);
  const Eigen::Vector2d centre(table.number(row, "cx"), table.number(row, "cy"));
  if (shape == "circle") return std::make_unique<Circle>(centre, positive(table, row, size_column));
  const bool rectangle = shape == "rectangle" || shape == "rect";
  if (!rectangle && shape != "ellipse") {
    const std::vector<std::string> known{"circle", "ellipse", "rectangle"};
    throw InputError(table.origin(row), shape_column + " is \"" + shape + "\", which is no shape" +
                                            suggestion(shape, known));
  }
  const double a = positive(table, row, size_column);
  const double b = positive(table, row, "b");
  const double angle = table.number(row, "psi");
  if (rectangle) return std::make_unique<Rectangle>(centre, a, b, angle);
  return std::make_unique<Ellipse>(centre, a, b, angle);
}

}  // namespace shoal::analysis
