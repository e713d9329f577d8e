#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace earshot::watch {

/// A message of the WebSocket, as it is sent.
struct Frame {
  bool is_binary = false;
  std::string bytes;
};

/// One viewer: what it subscribes to, and what it has still to be sent, at most kMostWaiting_bytes of messages.
class Viewer {
 public:
  using Channel = std::uint32_t;
  using Subscription = std::uint32_t;
  static constexpr std::size_t kMostWaiting_bytes = 4U << 20U;

  /// What the viewer must not miss: it goes before messages.
  void control(std::string json) { controls_.push_back({.is_binary = false, .bytes = std::move(json)}); }
  /// On a channel that it subscribes to, else nothing. Where too much waits, the oldest go.
  void send(Channel channel, std::uint64_t time_ns, std::string_view message);
  /// The time at which the flight is.
  void send_time(std::uint64_t time_ns);
  /// @return nothing when there is nothing to send
  [[nodiscard]] std::optional<Frame> next();
  [[nodiscard]] bool is_waiting() const { return !controls_.empty() || !messages_.empty(); }

  /// @return false: it has that subscription, or that channel, already
  [[nodiscard]] bool subscribe(Subscription subscription, Channel channel);
  /// @return false: it has none of that number
  [[nodiscard]] bool unsubscribe(Subscription subscription);

  std::string incoming;  ///< the beginning of a message that comes in pieces

 private:
  void queue(std::string bytes);

  std::map<Channel, Subscription> subscriptions_;
  std::deque<Frame> controls_;
  std::deque<std::string> messages_;
  std::size_t waiting_bytes_ = 0;
  std::uint64_t dropped_ = 0;  ///< since it was last told
};

/// {"op": "status", ...}, of a level: 0 for information, 1 a warning, 2 an error.
[[nodiscard]] std::string status(int level, std::string_view message);

}  // namespace earshot::watch
