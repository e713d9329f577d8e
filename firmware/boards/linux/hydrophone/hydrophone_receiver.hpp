#pragma once

#include <atomic>
#include <cstdint>
#include <stop_token>
#include <string>
#include <thread>

#include "firmware/boards/linux/hydrophone/block_ring.hpp"
#include "firmware/boards/linux/hydrophone/sample_sink.hpp"
#include "firmware/boards/linux/hydrophone/shared_counter.hpp"
#include "firmware/host/transport/lcm_endpoint.hpp"
#include "firmware/host/transport/wake_event.hpp"

namespace earshot::board {

/// Takes hydrophone_block_t off an LCM bus, beside the mission's loop: one thread receives, one listens, a ring between them. Nothing
/// allocates after construction. At its end the sink hears all that has been received.
class HydrophoneReceiver {
 public:
  /// @param sink  must outlive it
  /// @throws std::system_error, std::invalid_argument as LcmEndpoint and parse_lcm_url do.
  HydrophoneReceiver(const std::string& url, SampleSink& sink, host::IfMissing if_missing = host::IfMissing::kRefuse);
  ~HydrophoneReceiver() = default;
  HydrophoneReceiver(const HydrophoneReceiver&) = delete;
  HydrophoneReceiver& operator=(const HydrophoneReceiver&) = delete;

  struct Counters {
    std::uint64_t blocks = 0;             ///< put into the ring
    std::uint64_t samples_overrun = 0;    ///< of each channel, in blocks for which the ring had no room: the sink is too slow
    std::uint64_t malformed = 0;          ///< messages and datagrams
    std::uint64_t datagrams_overrun = 0;  ///< dropped by the kernel, or parts of blocks that never got whole: this thread is too slow
    bool link_up = true;
  };
  /// In any thread.
  [[nodiscard]] Counters counters() const;
  /// Bytes of its queues and its ring.
  [[nodiscard]] std::size_t memory() const { return endpoint_.memory() + BlockRing::memory(); }
  /// Names of the interfaces that it listened on at first: "lo, eth0".
  [[nodiscard]] const std::string& interfaces() const { return interfaces_; }

 private:
  void receive(const std::stop_token& stop);
  void take_all_that_arrived();
  void put(const wire::Lc02Message& message);
  void note_transport();
  void listen(const std::stop_token& stop);

  SampleSink& sink_;
  host::LcmEndpoint endpoint_;  ///< of the receiving thread alone
  std::string interfaces_;
  BlockRing ring_;
  host::WakeEvent stop_receiving_;
  host::WakeEvent put_;  ///< a block, or the end
  SharedCounter blocks_;
  SharedCounter samples_overrun_;
  SharedCounter malformed_blocks_;
  SharedCounter malformed_datagrams_;
  SharedCounter datagrams_overrun_;
  std::atomic<bool> link_up_;
  // Last, and in this order: each is told to stop and waited for as it goes, also when the next cannot be started; the sink goes after
  // who fills its ring, so that it hears all that was received.
  std::jthread listening_;
  std::jthread receiving_;
};

}  // namespace earshot::board
