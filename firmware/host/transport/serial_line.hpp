#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>

#include "firmware/host/file/file_descriptor.hpp"

namespace earshot::host {

/// A serial line: a terminal device (/dev/ttyACM0), raw, or, where an emulator stands in for one, a Unix socket.
class SerialLine {
 public:
  /// @param baud  of a device; a socket has none
  /// @throws host::BadInput naming the path, if it is neither or cannot be opened
  explicit SerialLine(const std::filesystem::path& path, unsigned baud = kBaud);

  static constexpr unsigned kBaud = 1'000'000;

  /// What has come, at most so much as there is room for; waits for the first byte.
  /// @return how many bytes; 0: none came in time
  /// @throws std::runtime_error when the line is gone
  [[nodiscard]] std::size_t read(std::span<std::uint8_t> bytes, std::chrono::milliseconds patience);

  /// All of them. @throws std::runtime_error when the line is gone, or takes nothing for so long
  void write(std::span<const std::uint8_t> bytes, std::chrono::milliseconds patience);

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  bool is_socket_;
  FileDescriptor file_;
};

}  // namespace earshot::host
