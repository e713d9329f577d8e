#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "firmware/desk/journal_view/export/topic_messages.hpp"

namespace earshot::watch {

/// Gives the messages of a journal to Foxglove and Lichtblick, over a WebSocket of this computer alone.
///
/// A viewer that comes late is given the last message of each topic that it subscribes to. One that reads too slowly loses its oldest
/// messages, and is told how many; it holds up neither the others nor who publishes. Web sites other than Foxglove's are refused, and so
/// are names of this computer that it does not have (DNS rebinding). A viewer can command nothing.
/// Memory: 4 MiB for each of at most 16 viewers, and the last message of each topic.
/// Source: Foxglove WebSocket Protocol Specification v1 (foxglove/ws-protocol).   Oracle: watch.foxglove (PyPI's websockets)
class FoxgloveServer {
 public:
  /// @param port  0: any that is free. @throws host::BadInput when it is taken
  explicit FoxgloveServer(std::uint16_t port);
  ~FoxgloveServer();
  FoxgloveServer(const FoxgloveServer&) = delete;
  FoxgloveServer& operator=(const FoxgloveServer&) = delete;

  [[nodiscard]] std::uint16_t port() const;
  /// Does not wait for any viewer. The topics must live as long as this.
  void publish(std::span<const journal::TopicMessage> messages);

 private:
  class Service;
  std::unique_ptr<Service> service_;
};

}  // namespace earshot::watch
