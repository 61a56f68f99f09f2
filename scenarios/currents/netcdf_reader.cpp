#include "shoal/scenarios/currents/netcdf_reader.hpp"

#include <cmath>

#include "shoal/core/text.hpp"

namespace shoal::scenarios {
namespace {

/// The fastest tidal streams on Earth reach about 10 m/s.
constexpr double fastest_m_s = 20.0;

}  // namespace

VelocityReader::VelocityReader(const NetcdfFile& file, const CurrentLayout& layout)
    : file_(file), layout_(layout), u_packing_(file, layout.u), v_packing_(file, layout.v) {
  if (layout.time && layout.time->is_dimension) times_ = layout.time->values.size();
  if (layout.depth && layout.depth->is_dimension) levels_ = layout.depth->values.size();
}

void VelocityReader::read(std::size_t time, std::size_t level,
                          std::vector<VelocityField::Node>& nodes) {
  read_component(layout_.u, u_packing_, layout_.u_unit_m_s, time, level, u_);
  read_component(layout_.v, v_packing_, layout_.v_unit_m_s, time, level, v_);
  constexpr float missing = std::numeric_limits<float>::quiet_NaN();
  nodes.resize(u_.size());
  for (std::size_t k = 0; k < u_.size(); ++k) {
    const bool land = !layout_.land.empty() && layout_.land[k];
    const bool dry = land || std::isnan(u_[k]) || std::isnan(v_[k]);
    nodes[k] = dry ? VelocityField::Node{missing, missing}
                   : VelocityField::Node{static_cast<float>(u_[k]), static_cast<float>(v_[k])};
  }
}

void VelocityReader::read_component(const NetcdfVariable& variable, const Packing& packing,
                                    double unit_m_s, std::size_t time, std::size_t level,
                                    std::vector<double>& values) const {
  const std::size_t rank = variable.dimensions.size();
  std::vector<std::size_t> start(rank, 0), count(rank, 1);
  if (layout_.time && layout_.time->is_dimension) start[layout_.time->position] = time;
  if (layout_.depth && layout_.depth->is_dimension) start[layout_.depth->position] = level;
  for (const std::size_t d : {rank - 2, rank - 1}) count[d] = variable.dimensions[d].length;
  file_.read(variable, start, count, values);
  for (double& value : values) {
    value = packing.value(value) * unit_m_s;
    if (std::abs(value) > fastest_m_s) {
      file_.refuse(variable.name + " holds a velocity of " + shortest(value) +
                   " m/s, which no current has; declare its _FillValue, or correct its units");
    }
  }
}

}  // namespace shoal::scenarios
