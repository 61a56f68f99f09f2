#include "shoal/analysis/study/folder_lock.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "shoal/core/error.hpp"

namespace shoal::analysis {

FolderLock::FolderLock(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / ".lock";
  file_ = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (file_ < 0) {
    throw SystemError("cannot write into " + folder.string() + ": " + std::strerror(errno) +
                      "; choose another folder with --out");
  }
  if (::flock(file_, LOCK_EX | LOCK_NB) == 0) return;
  const int why = errno;
  ::close(file_);
  if (why == EWOULDBLOCK) {
    throw SystemError(folder.string() +
                      " is in use by another shoal; wait for it to end, or choose "
                      "another folder with --out");
  }
  throw SystemError("cannot lock " + file.string() + ": " + std::strerror(why) +
                    "; choose a folder on a file system with locks");
}

FolderLock::~FolderLock() {
  ::close(file_);
}

}  // namespace shoal::analysis
