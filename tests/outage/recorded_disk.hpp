#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace earshot::outage {

using SteadyClock = std::chrono::steady_clock;

/// Something that a program did to a file, or to the folder that it stands in, and that has returned.
struct DiskCall {
  enum class Kind : std::uint8_t {
    kCreate,       ///< a file, empty; its entry in the folder is not on the disk yet
    kWrite,        ///< bytes from offset on
    kCut,          ///< the file ends at offset now
    kBringToDisk,  ///< all that was done to the file is on the disk
    kKeepEntries,  ///< all entries of the folder are on the disk
    kRemove,
  } kind = Kind::kCreate;
  std::string file = {};  ///< its name, without the folder; empty for kKeepEntries
  std::uint64_t offset = 0;
  std::vector<std::uint8_t> bytes = {};
  SteadyClock::time_point when = {};  ///< it returned
};

/// How a disk is now.
struct DiskMood {
  /// Asked before each call that costs a disk time; what it says is waited for first.
  std::function<std::chrono::microseconds()> delay = [] { return std::chrono::microseconds(0); };
  std::uint64_t room_bytes = UINT64_MAX;  ///< files together may hold so much; then the disk is full
  std::size_t most_at_once = SIZE_MAX;    ///< bytes that one write takes
};

/// Writes down what this process does to the files in one folder from now on: its calls of open, write, lseek, ftruncate, fallocate, fsync,
/// fdatasync and unlink go by here. One at a time in a process.
class RecordedDisk {
 public:
  explicit RecordedDisk(const std::filesystem::path& folder);
  ~RecordedDisk();
  RecordedDisk(const RecordedDisk&) = delete;
  RecordedDisk& operator=(const RecordedDisk&) = delete;

  void be(DiskMood mood);
  /// So far, in order.
  [[nodiscard]] std::vector<DiskCall> calls() const;
};

}  // namespace earshot::outage
