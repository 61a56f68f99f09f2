#include "shoal/analysis/experiments/evaluation.hpp"
#include "shoal/analysis/experiments/evaluations/obstacle_row.hpp"
#include "shoal/formations/fields/virtual_potential.hpp"

namespace shoal::analysis {
namespace {

using Eigen::Vector2d;

struct FieldEvaluation final : Evaluation {
  std::vector<Column> inputs() const override {
    return {{"kind", shape_meaning()},
            {"cx", "m, x of the obstacle's centre"},
            {"cy", "m, y of the obstacle's centre"},
            {"a", size_meaning},
            {"b", width_meaning},
            {"psi", angle_meaning},
            {"x", "m, x of the vehicle"},
            {"y", "m, y of the vehicle"},
            {"vx", "m/s, velocity of the vehicle along x"},
            {"vy", "m/s, velocity of the vehicle along y"},
            {"wx", "m, x of the waypoint"},
            {"wy", "m, y of the waypoint"}};
  }
  std::vector<Column> outputs() const override {
    return {{"d", "m, signed distance of the obstacle"},
            {"nx", "x of its outward unit normal"},
            {"ny", "y of its outward unit normal"},
            {"stator_x", "m/s2, repulsion of the obstacle, A+ = 18 m"},
            {"stator_y", "m/s2"},
            {"r_i", "alignment of eq. 28: 1 behind the obstacle, seen from the waypoint"},
            {"sigma", "sense of the rotor: 1 from x towards y, -1 the other way, 0 none"},
            {"rotor_x", "m/s2, rotor of the obstacle, A_r = 24 m"},
            {"rotor_y", "m/s2"},
            {"wp_x", "m/s2, attraction of the waypoint, A_0 = 0.05 m/s2, d_0 = 60 m"},
            {"wp_y", "m/s2"},
            {"vertex_at_cxcy_x",
             "m/s2, attraction of a cell vertex at (cx, cy), A_c = 0.05 m/s2, "
             "d_c = 10 m"},
            {"vertex_at_cxcy_y", "m/s2"}};
  }

  void evaluate(const CsvTable& table, std::size_t row, std::vector<double>& out) const override {
    const auto obstacle = obstacle_of(table, row, "kind", "a");
    const Vector2d place(table.number(row, "x"), table.number(row, "y"));
    const Vector2d velocity(table.number(row, "vx"), table.number(row, "vy"));
    const Vector2d waypoint(table.number(row, "wx"), table.number(row, "wy"));

    const formations::VirtualPotentialGains gains;
    const formations::Proximity near = obstacle->nearest(place);
    const auto turn = gains.rotor.turn(near.normal, obstacle->centre(), waypoint, velocity);
    const Vector2d stator = gains.obstacle.push(near.distance) * near.normal;
    const Vector2d rotor = gains.rotor.force(near, turn);
    const Vector2d to_waypoint = attraction(gains.waypoint, place - waypoint);
    const Vector2d to_vertex = attraction(gains.cell.vertex, place - obstacle->centre());
    out.insert(out.end(), {near.distance, near.normal.x(), near.normal.y(), stator.x(), stator.y(),
                           turn.alignment, static_cast<double>(turn.sense), rotor.x(), rotor.y(),
                           to_waypoint.x(), to_waypoint.y(), to_vertex.x(), to_vertex.y()});
  }

  template <class Contour>
  static Vector2d attraction(const Contour& contour, const Vector2d& from_feature) {
    return -formations::of_displacement(contour.at(from_feature.norm()), from_feature).gradient;
  }

  static void declare(Options<FieldEvaluation>&) {}
};

const Register<Evaluation, FieldEvaluation> registered{
    "field", "terms of the virtual potential's force (Barisic et al. 2011, eq. 6-29)"};

}  // namespace
}  // namespace shoal::analysis
