#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "firmware/desk/journal_view/events/timeline.hpp"
#include "firmware/desk/journal_view/export/topic_messages.hpp"
#include "policy/watch/foxglove/foxglove_server.hpp"

namespace earshot::watch {

/// A flight for viewers: each entry of its journal as messages on their topics. Another flight goes on on the same topics.
class FoxgloveFeed {
 public:
  /// @throws host::BadInput when the port is taken
  explicit FoxgloveFeed(std::uint16_t port) : server_(port) {}

  void take(const journal::Entry& entry);
  /// "ws://127.0.0.1:8765", which a viewer asks for
  [[nodiscard]] std::string url() const;

 private:
  journal::TopicMessages messages_{std::nullopt};  // no journal states where its mission lies
  journal::Timeline timeline_;
  FoxgloveServer server_;  // ends before its topics
};

}  // namespace earshot::watch
