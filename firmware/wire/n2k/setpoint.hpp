#pragma once

#include <cstdint>
#include <optional>

#include "firmware/core/fixed_vector.hpp"
#include "firmware/core/status.hpp"
#include "firmware/core/units.hpp"
#include "firmware/messages/setpoint.hpp"
#include "firmware/wire/n2k/fast_packet.hpp"
#include "firmware/wire/n2k/heard_frame.hpp"

namespace earshot::n2k {

/// Frames in the order in which they are to be sent: speed and depth (65290), then the fast packet of heading/track control (127237). A
/// receiver acts when it has both, a standard autopilot upon the heading alone: as the last frame sets off either, a set-point of which
/// only the beginning was sent changes nothing.
using SetpointFrames = FixedVector<Frame, 1 + kMaxFastPacketFrames>;

/// NMEA 2000 has no place for a way-point in these messages: the heading leads there. The order to release the drop weight goes with speed
/// and depth.
/// @param sequence  one higher for every set-point
/// @return kOutOfRange if a value is not finite or does not fit its message.
[[nodiscard]] Status compose_setpoint(const messages::Setpoint& setpoint, std::uint8_t source, std::uint8_t sequence,
                                      SetpointFrames& frames);

/// The autopilot's side (simulator, tests): a heading completes a set-point with the speed and depth that came before it and name the
/// sequence of its fast packet, so that no set-point is made of halves of two; its way-point stays empty.
/// The weight is to be released only where "Yes" says so: neither "not available" nor a value that nobody defined does.
class SetpointReceiver {
 public:
  /// kOk: `setpoint` is new. kNotReady: kept, or not ours. Otherwise refused.
  [[nodiscard]] Status accept(const HeardFrame& heard, messages::Setpoint& setpoint);
  /// Of the last set-point that was taken: the sequence of its fast packet, which an autopilot's status tells again.
  [[nodiscard]] std::optional<std::uint8_t> last_sequence() const { return last_sequence_; }

 private:
  struct SpeedDepth {
    MetersPerSecond speed;
    Meters depth;
    unsigned sequence;  ///< of the fast packet that goes with them
    std::uint8_t source;
    bool release_weight;
  };
  std::optional<SpeedDepth> speed_depth_;
  std::optional<std::uint8_t> last_sequence_;
  FastPacketAssembly assembly_;
};

}  // namespace earshot::n2k
