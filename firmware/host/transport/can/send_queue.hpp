#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "firmware/config/capacities.hpp"
#include "firmware/core/fixed_vector.hpp"
#include "firmware/core/status.hpp"
#include "firmware/core/time.hpp"
#include "firmware/wire/n2k/fast_packet.hpp"
#include "firmware/wire/n2k/frame.hpp"

namespace earshot::host {

/// Frames that belong together, in the order in which they go: at most a single frame and the longest fast packet (a set-point).
using CanGroup = FixedVector<n2k::Frame, 1 + n2k::kMaxFastPacketFrames>;

enum class WhileWaiting : std::uint8_t {
  kKeepEach,    ///< answers, reports: each says something else
  kKeepNewest,  ///< set-points: a newer group whose first frame has the same identifier takes the place of one that still waits
};

/// How a group waits if it has to.
struct Waiting {
  WhileWaiting kept = WhileWaiting::kKeepEach;
  Duration longest = Duration::seconds(1);  ///< a group that has not begun to go by then goes no more
};

/// Groups of frames; each that was pushed is one of these in the end, or still waits.
struct CanSendQueueCounters {
  std::uint64_t pushed = 0;
  std::uint64_t sent = 0;       ///< whole
  std::uint64_t replaced = 0;   ///< by a newer one
  std::uint64_t expired = 0;    ///< waited too long; no frame of it went
  std::uint64_t abandoned = 0;  ///< a part of it went, and the rest found no room in time
  std::uint64_t shed = 0;       ///< the queue was full, and it the oldest of the least urgent
  std::uint64_t refused = 0;    ///< the queue was full of more urgent ones
};

/// What waits for room in the interface's queue, by NMEA 2000 priority: the most urgent group first (by its most urgent frame), among
/// equals one that has begun to go, then the oldest. Only a more urgent group goes between the frames of another. Never waits itself.
class CanSendQueue {
 public:
  /// A group that has begun and comes no further is given up after this long: receivers give up its fast packet after 750 ms
  /// (n2k::kFastPacketTimeout), and part of it would be all that they ever had.
  static constexpr Duration kLongestGap = Duration::milliseconds(500);

  /// kOk: it waits. kFull: refused, as only more urgent ones wait; counted. kOutOfRange: no frame, or more than a group may have.
  [[nodiscard]] Status push(std::span<const n2k::Frame> frames, Time now, const Waiting& waiting);
  /// What goes next; null if nothing waits.
  [[nodiscard]] const n2k::Frame* next() const;
  /// The next one has gone.
  void pop(Time now);
  /// Gives up what has waited too long.
  void expire(Time now);

  [[nodiscard]] std::size_t waiting() const;
  /// Whether the group that was pushed last still waits.
  [[nodiscard]] bool holds_newest() const;
  [[nodiscard]] const CanSendQueueCounters& counters() const { return counters_; }

 private:
  struct Slot {
    CanGroup frames;       ///< none: the slot is free
    std::size_t gone = 0;  ///< frames of it that the kernel has
    unsigned priority = 7;
    std::uint64_t number = 0;  ///< in order of coming
    Time since;                ///< when it came, and once it has begun, when its last frame went
    Duration longest;
  };
  [[nodiscard]] Slot* find_slot(unsigned priority);
  void give_up_older(const n2k::Frame& first);
  [[nodiscard]] const Slot* head() const;

  std::array<Slot, config::kCanWaitingGroups> slots_{};
  std::uint64_t number_ = 0;
  CanSendQueueCounters counters_;
};

}  // namespace earshot::host
