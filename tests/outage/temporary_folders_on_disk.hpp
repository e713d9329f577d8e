#pragma once

#include <linux/magic.h>
#include <stdlib.h>
#include <sys/statfs.h>

#include <filesystem>

namespace earshot {

/// Made before a TemporaryFolder: that is on a disk, where /tmp may be in memory. What is in memory survives no power cut, and an order
/// that is kept there alone is OBEYED_NOT_DURABLE.
struct TemporaryFoldersOnDisk {
  TemporaryFoldersOnDisk() {
    struct statfs disk {};
    const bool is_in_memory = ::statfs(std::filesystem::temp_directory_path().c_str(), &disk) == 0 && disk.f_type == TMPFS_MAGIC;
    if (is_in_memory) ::setenv("TMPDIR", "/var/tmp", 1);
  }
};

}  // namespace earshot
