#pragma once

#include <mutex>

namespace shoal::scenarios {

/// Held around all calls of netCDF, in the program and in Python: neither netCDF nor HDF5 below it
/// is made for several threads. HDF5 stays silent meanwhile; what fails is reported by its status.
class NetcdfGuard {
 public:
  NetcdfGuard();

 private:
  std::unique_lock<std::mutex> lock_;
};

}  // namespace shoal::scenarios
