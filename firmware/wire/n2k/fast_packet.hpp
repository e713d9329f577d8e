#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "firmware/config/capacities.hpp"
#include "firmware/core/fixed_vector.hpp"
#include "firmware/core/status.hpp"
#include "firmware/core/time.hpp"
#include "firmware/wire/n2k/frame.hpp"
#include "firmware/wire/n2k/identifier.hpp"
#include "firmware/wire/n2k/table/signal.hpp"

namespace earshot::n2k {

// NMEA 2000 fast packet: a message of up to 223 bytes in numbered frames; a group that may be longer than 8 bytes comes so however short it
// is. Byte 0 of each frame: sequence (3 bits) and frame number (5 bits); byte 1 of frame 0: size of the message; then 6 bytes of it in
// frame 0, 7 in every other, padded with 0xFF. Source: NMEA 2000, as documented by canboat (Apache-2.0).   Oracle: recorded frames in
// tests/reference/n2k

inline constexpr std::size_t kMaxFastPacketFrames = 1 + (kMaxMessageSize - 6 + 6) / 7;

using FastPacketFrames = FixedVector<Frame, kMaxFastPacketFrames>;

/// @param sequence  of this message, taken modulo 8; one higher for every message of the same PGN
/// @return kOutOfRange if `bytes` is empty or has more than kMaxMessageSize, or the identifier does not compose.
[[nodiscard]] Status compose_fast_packet(const Identifier& identifier, std::uint8_t sequence, std::span<const std::uint8_t> bytes,
                                         FastPacketFrames& frames);

struct FastPacketCounters {
  std::uint64_t completed = 0;
  std::uint64_t abandoned = 0;  ///< a frame was missing, out of order or late, or a newer message took the slot
  std::uint64_t stray = 0;      ///< frames that continue nothing
  std::uint64_t too_large = 0;  ///< said to be over kMaxMessageSize, or empty
  std::uint64_t repeated = 0;   ///< frames that came twice, as CAN does when the very last bit of one is disturbed
};

/// A message put together.
struct Assembled {
  std::span<const std::uint8_t> bytes;  ///< valid until the next call
  Time began;                           ///< arrival of its first frame
};

/// A message whose frames are further apart is a new one's, whatever its numbers say.
inline constexpr Duration kFastPacketTimeout = Duration::milliseconds(750);

/// Puts frames together. One message per (source, destination, PGN) at a time in one of kFastPacketSlots; frames must come in order, as CAN
/// keeps them. A first frame restarts its slot; when all slots are taken, the one fed longest ago is given up.
class FastPacketAssembly {
 public:
  /// @param now  arrival of the frame
  /// @return kOk: whole. kNotReady: more to come. kMalformed: dropped and counted. kFull: too large, dropped and counted.
  [[nodiscard]] Status accept(const Identifier& identifier, const Frame& frame, Time now, Assembled& message);
  /// Likewise for who has no clock: frames may be any time apart.
  [[nodiscard]] Status accept(const Identifier& identifier, const Frame& frame, std::span<const std::uint8_t>& bytes);

  /// Whether this frame would go on with a message that is under way.
  [[nodiscard]] bool expects(const Identifier& identifier, const Frame& frame) const;

  [[nodiscard]] const FastPacketCounters& counters() const { return counters_; }

 private:
  struct Slot {
    bool used = false;
    Identifier identifier;
    std::uint8_t sequence = 0;
    std::uint8_t next_frame = 0;
    std::size_t size = 0;
    std::size_t filled = 0;
    std::uint64_t last_fed = 0;
    Time began;
    Time fed;
    std::array<std::uint8_t, kMaxMessageSize> bytes{};
  };
  [[nodiscard]] Status begin(const Identifier& identifier, const Frame& frame, Time now, Assembled& message);
  [[nodiscard]] Status go_on(Slot& slot, const Frame& frame, Time now, Assembled& message);
  [[nodiscard]] Status finish(Slot& slot, Assembled& message);
  [[nodiscard]] const Slot* find(const Identifier& identifier) const;
  [[nodiscard]] Slot& slot_for(const Identifier& identifier);

  std::array<Slot, config::kFastPacketSlots> slots_{};
  std::uint64_t turn_ = 0;
  FastPacketCounters counters_;
};
static_assert(sizeof(FastPacketAssembly) <= config::kFastPacketBytes);

}  // namespace earshot::n2k
