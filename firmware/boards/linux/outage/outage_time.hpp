#pragma once

#include "firmware/boards/linux/clock/host_clock.hpp"
#include "firmware/core/time.hpp"
#include "firmware/host/safety_record/safety_record.hpp"

namespace earshot::board {

/// For how long nobody has flown.
struct Outage {
  Duration passed;  ///< since the record was written, on the host's clock
  Duration least;   ///< of that, what is known for certain to lie behind the end of the process before
};

/// More than so much is not believed of the wall clock alone: a computer that starts again is there within minutes, and one that says more
/// may have been set (by a GNSS receiver, from a battery that was empty).
inline constexpr Duration kMostByWallClock = Duration::seconds(3600);

/// Where the computer has not started again since, its clock that counts from there says it exactly, whatever became of the wall clock.
/// Else the computer runs since then at the least, and the wall clock says how much longer it was, within kMostByWallClock: one that was
/// set back makes the outage the shortest that it can have been, one that was set ahead does not end a search that was short of a minute
/// away. Oracle: OutageTime.*
[[nodiscard]] Outage outage_since(const host::SafetyRecord& record, const HostClock& now);

}  // namespace earshot::board
