#pragma once

#include <chrono>
#include <cstddef>
#include <string>
#include <string_view>

namespace earshot::watch {

class Browser;

/// A browser at the other end of a socket, which may be slow, silent or gone: whatever waits for it ends.
/// Oracle: WatchServer.*
class Connection {
 public:
  static constexpr std::chrono::seconds kMostAnswerTime{60};  ///< for the page, from the beginning on
  static constexpr std::chrono::seconds kMostStall{60};       ///< of events: a browser that reads nothing for so long comes again by itself
  static constexpr std::chrono::seconds kHeartbeat{15};       ///< so often it is sent something, though there is no news
  static constexpr int kSendBuffer_bytes = 256 * 1024;        ///< of the kernel

  /// @param socket  remains the caller's
  /// @param stop    readable: the server ends, and nothing waits any longer
  Connection(int socket, int stop);

  /// False: it is gone, took too long, or the server ends.
  [[nodiscard]] bool send(std::string_view bytes);
  /// Its next event, or a sign of life. False likewise.
  [[nodiscard]] bool send_next(Browser& browser);

  /// Says that nothing more comes, and takes what the browser still sends: an answer before the end of a request is lost otherwise.
  void close_in_order() const;

  /// Of this computer, that it was made to: "127.0.0.1".
  [[nodiscard]] std::string own_address() const;

 private:
  enum class Woken { kReady, kSilent, kOver };
  /// Waits until the socket has one of `events` or `other` is readable.
  [[nodiscard]] Woken wait(short events, int other, std::chrono::milliseconds most) const;

  int socket_;
  int stop_;
  std::chrono::steady_clock::time_point began_ = std::chrono::steady_clock::now();
  bool has_events_ = false;
};

}  // namespace earshot::watch
