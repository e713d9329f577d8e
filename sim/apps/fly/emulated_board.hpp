#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "firmware/host/program/child_process.hpp"

namespace earshot::fly {

/// The boards by name: with the capacities of a vehicle computer, which every policy that ships fits, and those of a microcontroller.
inline constexpr const char* kBoardFull = "qemu-m7";
inline constexpr const char* kBoardSmall = "qemu-m7-small";

/// What runs on one of them, as it was built here.
/// @throws host::BadInput naming what has to be built first
[[nodiscard]] std::filesystem::path program_of_board(const std::string& name);

/// A Cortex-M7 in QEMU (machine mps2-an500) with the program of firmware/boards/cortex_m7, and its serial line as a Unix socket.
class EmulatedBoard {
 public:
  /// Waits until the line is there.
  /// @param run   of the flight; no two have the same
  /// @throws host::BadInput when there is no emulator; std::runtime_error when it does not come up
  EmulatedBoard(const std::filesystem::path& program, std::uint64_t run,
                const std::filesystem::path& emulator = "/usr/bin/qemu-system-arm");
  EmulatedBoard(const EmulatedBoard&) = delete;
  EmulatedBoard& operator=(const EmulatedBoard&) = delete;
  ~EmulatedBoard();

  [[nodiscard]] const std::filesystem::path& line() const { return line_; }

 private:
  std::filesystem::path line_;
  std::unique_ptr<program::ChildProcess> emulator_;
};

}  // namespace earshot::fly
