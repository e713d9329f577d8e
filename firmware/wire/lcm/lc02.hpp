#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "firmware/config/capacities.hpp"
#include "firmware/core/status.hpp"

namespace earshot::wire {

// The datagrams of LCM's UDP multicast transport, composed and taken apart in fixed memory. No socket is opened here.
//
//   short:       u32 'LC02', u32 sequence number, channel, 0, data
//   fragmented:  u32 'LC03', u32 sequence number, u32 data size, u32 fragment offset, u16 fragment number, u16 fragment count,
//                then channel, 0 in fragment 0 only, then this fragment's data                                   (all big-endian)
// Source: LCM 1.3.1, docs/content/udp-multicast-protocol; lcm_udpm.c.   Oracle: LiblcmPeer tests (liblcm itself as the other side)

inline constexpr std::uint32_t kShortMagic = 0x4c433032;     ///< "LC02"
inline constexpr std::uint32_t kFragmentMagic = 0x4c433033;  ///< "LC03"
inline constexpr std::size_t kShortHeaderSize = 8;           ///< bytes
inline constexpr std::size_t kFragmentHeaderSize = 20;       ///< bytes
inline constexpr std::size_t kMaxChannelLength = 63;         ///< bytes without the terminating zero (LCM_MAX_CHANNEL_NAME_LENGTH)
inline constexpr std::size_t kMaxDatagram = 65'507;          ///< bytes of UDP payload over IPv4
inline constexpr std::size_t kMaxShortPayload = 65'499;      ///< channel, its zero and data of a short message
inline constexpr std::size_t kMaxFragmentPayload = 65'487;   ///< channel, its zero and data of one fragment

struct Lc02Message {
  std::string_view channel;
  std::span<const std::uint8_t> data;
};

/// Who sent a datagram: IPv4 address and UDP port, as numbers that are only compared.
struct Sender {
  std::uint32_t address = 0;
  std::uint16_t port = 0;
  friend constexpr bool operator==(Sender, Sender) = default;
};

/// How many datagrams `message` takes; 0 if it cannot be sent (channel empty, too long or holding a zero, data over kLcmMessageBytes).
[[nodiscard]] std::size_t datagram_count(const Lc02Message& message);

/// Header (and channel) of datagram `index` of `message`, and the piece of the message's data that follows it: gathered by the socket, not
/// copied.
struct Datagram {
  std::array<std::uint8_t, kFragmentHeaderSize + kMaxChannelLength + 1> head;
  std::size_t head_size = 0;
  std::span<const std::uint8_t> data;
};
/// kOutOfRange unless index < datagram_count(message).
[[nodiscard]] Status compose(const Lc02Message& message, std::uint32_t sequence_number, std::size_t index, Datagram& datagram);

/// Why datagrams were dropped; the counters only grow.
struct ReceiveCounters {
  std::uint64_t malformed = 0;   ///< not LC02/LC03, truncated, channel without end, fragments that contradict each other
  std::uint64_t too_large = 0;   ///< a fragmented message over kLcmMessageBytes
  std::uint64_t incomplete = 0;  ///< fragmented messages given up: evicted by a newer one before all their fragments came
  std::uint64_t completed = 0;   ///< messages handed out
};

/// Takes datagrams, gives messages. A message in fragments occupies one of kLcmReassemblySlots from its first fragment to arrive (in any
/// order, from one sender, under one sequence number) until it is whole. When all slots are taken, the one that waited longest for its next
/// fragment is given up. A slot never given its last fragment is therefore reclaimed by need, not by time. About kLcmReassemblySlots *
/// kLcmMessageBytes bytes: keep it off the stack.
class Reassembly {
 public:
  /// @param message  valid until the next call; views `datagram` when it was a short message
  /// @return kOk: a message is whole. kNotReady: a fragment was kept. kMalformed, kFull (too large): dropped and counted.
  [[nodiscard]] Status accept(std::span<const std::uint8_t> datagram, Sender sender, Lc02Message& message);

  [[nodiscard]] const ReceiveCounters& counters() const { return counters_; }

 private:
  static constexpr std::size_t kMaxFragments = 256;  ///< of one message: more than kLcmMessageBytes in fragments of an Ethernet frame
  /// Where a fragment's data goes; bytes from the message's beginning.
  struct Extent {
    std::uint32_t begin = 0;
    std::uint32_t end = 0;
    bool seen = false;
  };
  struct Slot {
    bool used = false;
    Sender sender;
    std::uint32_t sequence_number = 0;
    std::uint32_t size = 0;  ///< of the data, bytes
    std::uint16_t fragment_count = 0;
    std::uint16_t fragments_seen = 0;
    std::uint64_t last_fed = 0;  ///< turn of the last fragment
    std::size_t channel_length = 0;
    std::array<char, kMaxChannelLength> channel{};
    std::array<Extent, kMaxFragments> fragments{};
    std::array<std::uint8_t, config::kLcmMessageBytes> data{};
  };
  struct Fragment;

  [[nodiscard]] Status accept_short(std::span<const std::uint8_t> datagram, Lc02Message& message);
  [[nodiscard]] Status accept_fragment(std::span<const std::uint8_t> datagram, Sender sender, Lc02Message& message);
  [[nodiscard]] static bool is_whole(const Slot& slot);
  [[nodiscard]] Slot& slot_for(const Fragment& fragment, Sender sender);
  [[nodiscard]] Status malformed();

  std::array<Slot, config::kLcmReassemblySlots> slots_{};
  std::uint64_t turn_ = 0;
  ReceiveCounters counters_;
};

}  // namespace earshot::wire
