#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>

namespace earshot::support {

/// A file system in memory that is really full when it is full, seen by this process alone. Must be made before any thread starts.
class SmallDisk {
 public:
  /// @param bytes  a multiple of 4096
  /// @return nothing where the kernel does not let us (not root and no user namespaces)
  [[nodiscard]] static std::unique_ptr<SmallDisk> make(std::uint64_t bytes);
  ~SmallDisk();
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;

  /// @return whether it has this size now
  [[nodiscard]] bool resize(std::uint64_t bytes) const;
  /// As a disk that is checked before it is written to, or one that has become sick. @return whether it is so now
  [[nodiscard]] bool set_read_only(bool is_read_only) const;
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  explicit SmallDisk(std::filesystem::path path) : path_(std::move(path)) {}
  std::filesystem::path path_;
};

}  // namespace earshot::support
