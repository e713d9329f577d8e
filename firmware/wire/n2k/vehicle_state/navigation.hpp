#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "firmware/core/status.hpp"
#include "firmware/core/time.hpp"
#include "firmware/messages/navigation.hpp"
#include "firmware/wire/n2k/heard_frame.hpp"
#include "firmware/wire/n2k/local_plane.hpp"
#include "firmware/wire/n2k/sensors/sensors.hpp"

namespace earshot::n2k {

/// Frames in the order in which they are to be sent: heading, speed, pressure, position.
using NavigationFrames = std::array<Frame, 4>;

/// Four messages, without the date, which none of them carries. A speed that is not known (NaN) is sent as not available. kOutOfRange if
/// another value is not finite, or one does not fit its message.
/// Resolution: 1e-7 degree (11 mm), 0.1 Pa (0.01 mm of depth), 1e-4 rad, 0.01 m/s.
[[nodiscard]] Status compose_navigation(const messages::Navigation& navigation, const LocalPlane& plane, std::uint8_t source,
                                        NavigationFrames& frames);

/// Where the vehicle is, as its devices say. What is missing is missing.
struct Fix {
  Time time;  ///< arrival of the position (of its first frame)
  NorthEast position;
  Meters depth;
  Radians heading;
  std::optional<MetersPerSecond> speed;  ///< through the water; nothing on the vehicle needs it, so a fix does not wait for it
};

struct NavigationSettings {
  SensorSettings sensors;
  /// Between the arrivals of a position and of the heading, depth and speed that go with it, at most. Pressure is the slowest: by the
  /// standard it comes every two seconds. A vehicle under way at 2 m/s turns and dives little in three.
  Duration oldest_part = Duration::seconds(3);
};

struct NavigationCounters {
  std::uint64_t accepted = 0;  ///< positions that gave a fix
  /// Frames of ours that are malformed, out of range, or in a reference that is not taken (magnetic heading without a variation).
  std::uint64_t refused = 0;
  std::uint64_t malformed = 0;  ///< of those: they do not say what their group has to, or no number that it may have
  std::uint64_t waiting = 0;    ///< positions that came while heading or depth was missing or too old
  std::uint64_t other = 0;      ///< frames of other PGNs, and pressures of the air
};

/// Makes fixes of what Sensors reads: every position is one, provided that heading and depth are no more than `oldest_part` from it. It
/// bears the position's date, not that of the moment it is made.
class NavigationReceiver {
 public:
  explicit NavigationReceiver(const LocalPlane& plane) : plane_(plane) {}
  NavigationReceiver(const LocalPlane& plane, const NavigationSettings& settings)
      : plane_(plane), oldest_part_(settings.oldest_part), sensors_(settings.sensors) {}

  /// @param now  arrival of the frame
  /// @return kOk: `fix` is new. kNotReady: kept, or not ours. kOutOfRange, kMalformed, kUnsupported: refused and counted. kStale: a
  /// position, but heading or depth is missing or old.
  [[nodiscard]] Status accept(const HeardFrame& heard, Time now, Fix& fix);
  /// Likewise; a speed that is missing is messages::kUnknownSpeed.
  [[nodiscard]] Status accept(const HeardFrame& heard, Time now, messages::Navigation& navigation);

  [[nodiscard]] const NavigationCounters& counters() const { return counters_; }
  [[nodiscard]] const Sensors& sensors() const { return sensors_; }
  [[nodiscard]] Status zero_at_surface() { return sensors_.zero_at_surface(); }

 private:
  LocalPlane plane_;
  Duration oldest_part_ = NavigationSettings{}.oldest_part;
  Sensors sensors_;
  NavigationCounters counters_;

  [[nodiscard]] Status complete(Fix& fix) const;
};

}  // namespace earshot::n2k
