#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "firmware/host/file/file_descriptor.hpp"
#include "firmware/host/transport/lcm_url.hpp"
#include "firmware/wire/lcm/lc02.hpp"
#include "hil/nodes/lcm/message.hpp"

namespace earshot::hil {

/// LCM's group on this host, for one who sends what no LCM library would (damaged datagrams), and must know that it has arrived: it hears
/// itself.
class Network {
 public:
  /// @param url  with ttl=0   @throws std::system_error naming the call that failed
  explicit Network(const host::LcmUrl& url);

  /// @return whether everybody in the group has it in his socket; false when it did not come round in 2 s
  [[nodiscard]] bool send(std::span<const std::uint8_t> datagram);
  /// The next message of somebody else; nothing when none came for `most_ms`.
  [[nodiscard]] std::optional<LcmMessage> receive(int most_ms);

 private:
  struct Arrival {
    wire::Sender from;
    std::vector<std::uint8_t> datagram;
  };
  [[nodiscard]] std::optional<Arrival> next(int most_ms);

  host::FileDescriptor sender_;
  host::FileDescriptor receiver_;
  wire::Sender self_;
  std::deque<Arrival> waiting_;  ///< others', that came while it waited for itself
  std::unique_ptr<wire::Reassembly> reassembly_ = std::make_unique<wire::Reassembly>();
};

}  // namespace earshot::hil
