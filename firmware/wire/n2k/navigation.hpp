#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "firmware/core/status.hpp"
#include "firmware/core/time.hpp"
#include "firmware/messages/navigation.hpp"
#include "firmware/wire/n2k/frame.hpp"
#include "firmware/wire/n2k/local_plane.hpp"

namespace earshot::n2k {

/// Frames in the order in which they are to be sent: heading, speed, pressure, position.
using NavigationFrames = std::array<Frame, 4>;

/// Four messages, without the date, which none of them carries. kOutOfRange if a value is not finite or does not fit its message.
/// Resolution: 1e-7 degree (11 mm), 0.1 Pa (0.01 mm of depth), 1e-4 rad, 0.01 m/s.
[[nodiscard]] Status compose_navigation(const messages::Navigation& navigation, const LocalPlane& plane, std::uint8_t source,
                                        NavigationFrames& frames);

struct NavigationCounters {
  std::uint64_t accepted = 0;  ///< positions that gave a Navigation
  /// Frames of ours that are malformed, out of range, or in a reference we do not take (magnetic heading, air pressure).
  std::uint64_t refused = 0;
  std::uint64_t waiting = 0;  ///< positions that came while heading, speed or pressure was missing or stale
  std::uint64_t other = 0;    ///< frames of other PGNs
};

/// Collects heading, speed and pressure; every position completes them to one navigation fix, provided none is older than its message's
/// timeout. Devices are told apart by PGN only: the bus of this vehicle has one of each.
class NavigationReceiver {
 public:
  explicit NavigationReceiver(const LocalPlane& plane) : plane_(plane) {}

  /// kOk: `navigation` is new, and dated `now`. kNotReady: kept, or not ours. kOutOfRange, kMalformed: refused and counted. kStale: a
  /// position, but the rest is missing or old.
  [[nodiscard]] Status accept(const Frame& frame, Time now, messages::Navigation& navigation);

  [[nodiscard]] const NavigationCounters& counters() const { return counters_; }

 private:
  struct Sample {
    double value = 0.0;
    Time time;
  };
  LocalPlane plane_;
  std::optional<Sample> heading_;
  std::optional<Sample> speed_;
  std::optional<Sample> depth_;
  NavigationCounters counters_;

  [[nodiscard]] Status keep(std::uint32_t pgn, const Frame& frame, Time now);
  [[nodiscard]] Status complete(const Frame& frame, Time now, messages::Navigation& navigation);
};

}  // namespace earshot::n2k
