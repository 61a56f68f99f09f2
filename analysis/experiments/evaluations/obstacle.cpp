#include "shoal/analysis/experiments/evaluation.hpp"
#include "shoal/analysis/experiments/evaluations/obstacle_row.hpp"

namespace shoal::analysis {
namespace {

struct ObstacleEvaluation final : Evaluation {
  std::vector<Column> inputs() const override {
    return {{"shape", shape_meaning()}, {"cx", "m, x of the centre"}, {"cy", "m, y of the centre"},
            {"a_or_r", size_meaning},   {"b", width_meaning},         {"psi", angle_meaning},
            {"px", "m, x of a place"},  {"py", "m, y of a place"}};
  }
  std::vector<Column> outputs() const override {
    return {{"signed_distance", "m, of the place; negative inside"},
            {"nx", "x of the outward unit normal"},
            {"ny", "y of the outward unit normal"},
            {"closest_x", "m, x of the nearest point of the edge"},
            {"closest_y", "m, y of the nearest point of the edge"},
            {"unique",
             "0 where several points or normals would do, and one is printed: (1, 0) in "
             "the middle of a circle, else the positive side of an axis, and the end of "
             "psi's axis before its side"}};
  }

  void evaluate(const CsvTable& table, std::size_t row, std::vector<double>& out) const override {
    const auto obstacle = obstacle_of(table, row, "shape", "a_or_r");
    const Eigen::Vector2d place(table.number(row, "px"), table.number(row, "py"));
    const formations::Proximity near = obstacle->nearest(place);
    const Eigen::Vector2d closest = near.closest(place);
    out.insert(out.end(), {near.distance, near.normal.x(), near.normal.y(), closest.x(),
                           closest.y(), near.unique ? 1.0 : 0.0});
  }

  static void declare(Options<ObstacleEvaluation>&) {}
};

const Register<Evaluation, ObstacleEvaluation> registered{
    "obstacle", "distance and normal of an obstacle (Barisic et al. 2011, eq. 46-62)"};

}  // namespace
}  // namespace shoal::analysis
