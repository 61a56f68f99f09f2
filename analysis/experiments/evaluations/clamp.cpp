#include "shoal/analysis/experiments/evaluation.hpp"
#include "shoal/core/text.hpp"
#include "shoal/formations/conditioning.hpp"

namespace shoal::analysis {
namespace {

struct ClampEvaluation final : Evaluation {
  std::vector<Column> inputs() const override {
    return {{"f_par", "m/s2, force along the heading"},
            {"f_perp", "m/s2, force across it, where positive turns lead"},
            {"u_prev", "m/s, forward speed"},
            {"r_prev", "rad/s, turn rate"},
            {"T", "s, period of the commands"},
            {"u_max", "m/s, highest speed"},
            {"u_min", "m/s, lowest speed; else 0", true},
            {"du_max", "m/s2, fastest change of the speed"},
            {"r_max", "rad/s, fastest turn"},
            {"dr_max", "rad/s2, fastest change of the turn rate"}};
  }
  std::vector<Column> outputs() const override {
    return {{"u_cmd", "m/s, commanded speed"},
            {"dpsi_cmd", "rad, commanded turn within the period"},
            {"f_par_out", "m/s2, admissible force along the heading"},
            {"f_perp_out", "m/s2, admissible force across it"}};
  }

  void evaluate(const CsvTable& table, std::size_t row, std::vector<double>& out) const override {
    formations::PerformanceEnvelope envelope{
        .speed_max_m_s = positive(table, row, "u_max"),
        .acceleration_max_m_s2 = positive(table, row, "du_max"),
        .turn_rate_max_rad_s = positive(table, row, "r_max"),
        .turn_acceleration_max_rad_s2 = positive(table, row, "dr_max")};
    if (table.has("u_min")) envelope.speed_min_m_s = table.number(row, "u_min");
    if (!(envelope.speed_min_m_s >= 0.0 && envelope.speed_min_m_s <= envelope.speed_max_m_s)) {
      throw InputError(table.origin(row), "u_min is " + shortest(envelope.speed_min_m_s) +
                                              "; it takes a number from 0 to u_max");
    }
    const auto command = conditioned({table.number(row, "f_par"), table.number(row, "f_perp")},
                                     {table.number(row, "u_prev"), table.number(row, "r_prev")},
                                     positive(table, row, "T"), envelope);
    out.insert(out.end(),
               {command.speed_m_s, command.turn_rad, command.force.x(), command.force.y()});
  }

  static void declare(Options<ClampEvaluation>&) {}
};

const Register<Evaluation, ClampEvaluation> registered{
    "clamp", "a force made admissible (Barisic et al. 2011, Table 3 as corrected)"};

}  // namespace
}  // namespace shoal::analysis
