#include "shoal/scenarios/netcdf_guard.hpp"

#include <hdf5.h>

namespace shoal::scenarios {
namespace {

std::mutex& netcdf_mutex() {
  static std::mutex mutex;
  return mutex;
}

}  // namespace

NetcdfGuard::NetcdfGuard() : lock_(netcdf_mutex()) {
  // Each thread has an error handler of its own, which prints unless it is removed.
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

}  // namespace shoal::scenarios
