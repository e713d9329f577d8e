#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "firmware/config/listening_window.hpp"
#include "firmware/host/program/command_line.hpp"

namespace earshot::command_line {

/// The part of a command line that says over which window an observation listens.
struct ListeningOptions {
  std::optional<std::string> listening = {};
  std::optional<std::uint32_t> listening_window_s = {};

  /// @param otherwise  what help says holds when neither is given
  void add_to(program::CommandLine& line, const std::string& otherwise);
  [[nodiscard]] bool is_given() const { return listening || listening_window_s; }
  /// A word alone takes the length that stands, but for newest, which has none; a length alone the word that stands.
  /// @param standing  what holds where nothing is given
  /// Throws host::BadInput for a window that cannot be listened over.
  [[nodiscard]] config::ListeningWindow applied_to(config::ListeningWindow standing) const;
};

}  // namespace earshot::command_line
