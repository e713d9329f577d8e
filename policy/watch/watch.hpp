#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "firmware/host/transport/lcm_url.hpp"

namespace earshot::watch {

inline constexpr const char* kLcm = "lcm";            ///< in place of a journal
inline constexpr std::uint32_t kFoxglovePort = 8765;  ///< where viewers expect it

/// What a person asks of `earshot watch`.
struct WatchOptions {
  std::string what;  ///< a journal, its folder, or kLcm
  std::string lcm_url{host::kDefaultLcmUrl};
  std::optional<std::uint32_t> wait_s = std::nullopt;  ///< for a mission that begins; nothing: for none
  std::optional<std::uint32_t> port = std::nullopt;    ///< nothing: kUsualPort, or any where that is taken
  std::optional<std::string> listen = std::nullopt;    ///< nothing: this computer alone
  std::optional<std::filesystem::path> password_file = std::nullopt;
  bool open = false;      ///< in a browser, where there is a desktop
  bool foxglove = false;  ///< serve Foxglove and Lichtblick, too
  std::uint32_t foxglove_port = kFoxglovePort;
};

/// Serves the page of a flight until a signal ends it. @return the exit status of `earshot watch`
/// @throws host::BadInput when what is asked for cannot be
[[nodiscard]] int watch(const WatchOptions& options);

}  // namespace earshot::watch
