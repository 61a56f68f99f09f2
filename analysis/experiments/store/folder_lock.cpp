#include "shoal/analysis/experiments/store/folder_lock.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "shoal/core/error.hpp"

namespace shoal::analysis {

FolderLock::FolderLock(const std::filesystem::path& folder, Purpose purpose) {
  const std::filesystem::path file = folder / ".lock";
  const bool reads = purpose == Purpose::read;
  file_ = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (file_ < 0 && reads) {
    const int why = errno;
    file_ = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
    const bool not_writable = why == EROFS || why == EACCES;
    if (file_ < 0 && errno == ENOENT && not_writable) return;
  }
  if (file_ < 0) {
    throw SystemError("cannot write into " + folder.string() + ": " + std::strerror(errno) +
                      "; choose another folder");
  }
  if (::flock(file_, (reads ? LOCK_SH : LOCK_EX) | LOCK_NB) == 0) return;
  const int why = errno;
  ::close(file_);
  if (why == EWOULDBLOCK) {
    throw SystemError(folder.string() +
                      " is in use by another shoal; wait for it to end, or choose another folder");
  }
  throw SystemError("cannot lock " + file.string() + ": " + std::strerror(why) +
                    "; choose a folder on a file system with locks");
}

FolderLock::~FolderLock() {
  if (file_ >= 0) ::close(file_);
}

}  // namespace shoal::analysis
