#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <mutex>
#include <string>

namespace shoal::scenarios {

/// Of memory that a file may take while it is read, in all.
inline constexpr std::size_t most_netcdf_bytes = 1'000'000'000;

/// Held around all calls of netCDF, in the program and in Python: neither netCDF nor HDF5 below it
/// is made for several threads. HDF5 stays silent meanwhile; what fails is reported by its status.
class NetcdfGuard {
 public:
  NetcdfGuard();

 private:
  std::unique_lock<std::mutex> lock_;
};

/// Reads a file in a child process, and throws away what was read. HDF5 may crash, loop or ask for
/// any memory on a damaged file, and no check of shoal comes before that.
///
/// `bytes` is the size of the file, which sets how much time and memory it may take. Throws
/// InputError if the child crashes or exceeds them (slowness is no damage: it says so); a child
/// that is blocked is begun again. What else `read` throws is left to the reading that comes after.
/// No NetcdfGuard may be held.
void rehearse_netcdf(const std::string& name, std::uintmax_t bytes,
                     const std::function<void()>& read);

}  // namespace shoal::scenarios
