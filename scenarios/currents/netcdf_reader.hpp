#pragma once

#include <cstddef>
#include <vector>

#include "shoal/scenarios/currents/netcdf_field.hpp"
#include "shoal/scenarios/currents/netcdf_layout.hpp"
#include "shoal/scenarios/currents/netcdf_values.hpp"

namespace shoal::scenarios {

/// Reads the velocities of a file, the nodes of one time and one level at a go.
class VelocityReader {
 public:
  VelocityReader(const NetcdfFile& file, const CurrentLayout& layout);

  std::size_t times() const { return times_; }
  std::size_t levels() const { return levels_; }
  const Packing& u_packing() const { return u_packing_; }
  const Packing& v_packing() const { return v_packing_; }

  /// Components as in the file, m/s, nodes in the order of the file; both NaN where u, v or the
  /// mask says that there is no water. Refuses infinite values and speeds that no current has:
  /// these are fill values that were not declared.
  void read(std::size_t time, std::size_t level, std::vector<VelocityField::Node>& nodes);

 private:
  void read_component(const NetcdfVariable& variable, const Packing& packing, double unit_m_s,
                      std::size_t time, std::size_t level, std::vector<double>& values) const;

  const NetcdfFile& file_;
  const CurrentLayout& layout_;
  Packing u_packing_, v_packing_;
  std::size_t times_ = 1, levels_ = 1;
  std::vector<double> u_, v_;
};

}  // namespace shoal::scenarios
