#include "shoal/scenarios/vehicles/nps_auv/hydrodynamics.hpp"

#include <array>

#include "shoal/analysis/experiments/evaluation.hpp"

namespace shoal::analysis {
namespace {

constexpr std::array<const char*, 12> states{"u", "v", "w", "p",   "q",     "r",
                                             "x", "y", "z", "phi", "theta", "psi"};
constexpr std::array<const char*, 6> forces{"F_X", "F_Y", "F_Z", "F_K", "F_M", "F_N"};

struct NpsAuvEvaluation final : Evaluation {
  scenarios::NpsAuvModel model;

  std::vector<Column> inputs() const override {
    std::vector<Column> columns;
    for (std::size_t i = 0; i < states.size(); ++i) {
      columns.push_back({states[i], i < 3   ? "m/s, velocity through the water, body axes"
                                    : i < 6 ? "rad/s, turn rate, body axes"
                                    : i < 9 ? "m: north, east, down"
                                            : "rad, attitude"});
    }
    columns.insert(columns.end(), {{"delta_r", "rad, rudder"},
                                   {"delta_s", "rad, stern planes"},
                                   {"delta_bp", "rad, port bow plane"},
                                   {"delta_bs", "rad, starboard bow plane"},
                                   {"n_rad_s", "rad/s, propeller"}});
    return columns;
  }

  std::vector<Column> outputs() const override {
    std::vector<Column> columns;
    for (const char* state : states) {
      columns.push_back({"d" + std::string(state), "derivative of " + std::string(state)});
    }
    for (std::size_t i = 0; i < forces.size(); ++i) {
      columns.push_back({forces[i], i < 3 ? "N, right-hand side of eq. 31-33"
                                          : "N m, right-hand side of eq. 34-36"});
    }
    columns.push_back({"epsilon", "effect of the propeller's race, eq. 39"});
    return columns;
  }

  void evaluate(const CsvTable& table, std::size_t row, std::vector<double>& out) const override {
    scenarios::VehicleState x;
    for (std::size_t i = 0; i < states.size(); ++i) {
      x(static_cast<Eigen::Index>(i)) = table.number(row, states[i]);
    }
    const scenarios::NpsAuvInputs in{table.number(row, "delta_r"), table.number(row, "delta_s"),
                                     table.number(row, "delta_bp"), table.number(row, "delta_bs"),
                                     table.number(row, "n_rad_s")};
    const scenarios::VehicleState rate = model.derivative(x, in);
    const auto force = model.forces(x, in);
    out.insert(out.end(), rate.begin(), rate.end());
    out.insert(out.end(), force.begin(), force.end());
    out.push_back(model.epsilon(x(0), in.propeller_rad_s));
  }

  static void declare(Options<NpsAuvEvaluation>&) {}
};

const Register<Evaluation, NpsAuvEvaluation> registered{
    "nps_auv", "the 6-DOF vehicle's derivatives (Barisic et al. 2011, eq. 31-40, Table 1)"};

}  // namespace
}  // namespace shoal::analysis
