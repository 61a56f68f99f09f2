#pragma once

#include <filesystem>

namespace shoal::analysis {

/// Holds a folder for one writer, or for readers that want no writer there; lets go when it is
/// destroyed or its process ends, however it ends.
class FolderLock {
 public:
  enum class Purpose { write, read };

  /// Throws SystemError if another program holds the folder, or if it is to be written and nothing
  /// can be. A folder in which nothing can be written needs no lock for reading.
  explicit FolderLock(const std::filesystem::path& folder, Purpose purpose = Purpose::write);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int file_;
};

}  // namespace shoal::analysis
