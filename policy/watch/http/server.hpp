#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "firmware/host/file/bad_input.hpp"
#include "policy/watch/http/audience.hpp"
#include "policy/watch/http/password.hpp"

namespace earshot::watch {

inline constexpr std::uint16_t kUsualPort = 8020;
inline constexpr const char* kLoopback = "127.0.0.1";

struct ServerSettings {
  std::string address = kLoopback;  ///< of this computer; 0.0.0.0, ::: all of it
  std::uint16_t port = kUsualPort;  ///< 0: one that is free
  std::optional<Password> password = std::nullopt;
  std::string_view page;  ///< HTML
};

/// Another program has the port.
class PortTaken : public host::BadInput {
 public:
  using BadInput::BadInput;
};

/// "192.168.2.7", "::1": an address, and no name of one.
[[nodiscard]] bool is_address(const std::string& text);

/// Serves the page, and its events to an Audience, by HTTP/1.1 in threads of its own. It only lets read. Whatever browsers send or leave
/// undone, it holds so many threads, and bytes of each browser, at most; further connections are answered with 503.
/// Oracle: WatchServer.*
class Server {
 public:
  static constexpr std::size_t kMostThreads = Audience::kMostBrowsers + 16;  ///< one for each connection

  /// Begins to serve. @throws PortTaken; host::BadInput when the address is not this computer's, or may not be used
  Server(const ServerSettings& settings, Audience& audience);
  /// Ends all connections.
  ~Server();
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  /// Where a browser on this computer finds it.
  [[nodiscard]] const std::string& url() const { return url_; }
  /// The operating system let it accept no connections any more.
  [[nodiscard]] bool has_failed() const;

 private:
  class Http;
  std::string url_;
  std::unique_ptr<Http> http_;
};

}  // namespace earshot::watch
