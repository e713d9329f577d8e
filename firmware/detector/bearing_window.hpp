#pragma once

#include <cstdint>
#include <optional>

#include "firmware/core/time.hpp"
#include "firmware/messages/bearing_measurement.hpp"

namespace earshot::detector {

/// How long a sender of bearings may be silent before another takes its place: a blue whale calls every one or two minutes, and an array
/// that hears none has nothing to send.
inline constexpr Duration kBearingHandover = Duration::seconds(120);

/// Judges the bearings that come in, and remembers the newest of one sender: two arrays differ by what each has wrong, and taken in turns
/// they would pass for a source that jumps. The first that is heard is the one, until it has given no bearing that is taken for longer than
/// kBearingHandover.
/// Oracle: BearingWindow.*
class BearingWindow {
 public:
  enum class Verdict : std::uint8_t {
    kTaken,
    kRefused,   ///< an angle that is none, older than the last that was taken, or dated further from its arrival than allowed
    kOfAnother  ///< of a second sender, while the first is listened to; nothing else is wrong with it
  };

  /// @param port      by which it came; senders of several ports are several senders, whatever their numbers
  /// @param farthest  that a date may lie from its arrival; one ahead of its arrival counts as the arrival
  [[nodiscard]] Verdict take(Time arrival, std::uint8_t port, const messages::BearingMeasurement& measurement, Duration farthest);

  /// A decision has been made: bearings up to `now` count no more, whenever they arrive, so that none is counted twice.
  void begin_leg(Time now) { leg_began_ = now; }

  /// The newest, if it is of this leg and dated after `after`.
  [[nodiscard]] std::optional<messages::Bearing> heard_after(Time after) const;

 private:
  struct Held {
    std::uint8_t port = 0;
    Time arrival;
    messages::BearingMeasurement newest;
  };
  std::optional<Held> held_;
  std::optional<Time> leg_began_;  ///< before the first leg: none, and every bearing counts
};

}  // namespace earshot::detector
