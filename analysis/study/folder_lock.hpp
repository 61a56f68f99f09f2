#pragma once

#include <filesystem>

namespace shoal::analysis {

/// Holds a folder for one writer; lets go when it is destroyed or its process ends, however it
/// ends.
class FolderLock {
 public:
  /// Throws SystemError if another program holds the folder, or if nothing can be written there.
  explicit FolderLock(const std::filesystem::path& folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int file_;
};

}  // namespace shoal::analysis
