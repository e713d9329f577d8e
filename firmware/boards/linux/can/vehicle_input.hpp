#pragma once

#include <cstdint>

#include "firmware/boards/linux/can/arrival.hpp"
#include "firmware/boards/linux/port/input_sink.hpp"
#include "firmware/core/status.hpp"
#include "firmware/core/time.hpp"
#include "firmware/wire/n2k/heard_frame.hpp"
#include "firmware/wire/n2k/local_plane.hpp"
#include "firmware/wire/n2k/vehicle_state/navigation.hpp"
#include "firmware/wire/n2k/vehicle_state/vehicle_condition.hpp"

namespace earshot::board {

/// Where the vehicle is and how it is, as its devices say: owns the last readings of each, the directory of the devices on the bus, and the
/// counts of fixes and statuses.
class VehicleInput {
 public:
  VehicleInput(std::uint8_t port, const n2k::LocalPlane& plane, const n2k::NavigationSettings& settings)
      : port_(port), oldest_part_(settings.oldest_part), receiver_(plane, settings), condition_(settings.oldest_part) {}

  /// A frame of a sensor, or the claim of any device, which may be known by its NAME.
  void take(const n2k::HeardFrame& heard, const Arrival& arrival, InputSink& sink);
  /// Any frame before the first turn: nothing of it is an input, and only a claim is kept.
  void note_claim(const n2k::HeardFrame& heard);
  /// @param heard  of 65293
  /// @return what is wrong with it
  [[nodiscard]] Status take_hull(const n2k::HeardFrame& heard, const Arrival& arrival);
  /// To be called at the end of a reading, so that a status holds all that has come.
  void give_status(Time now, InputSink& sink);

  [[nodiscard]] bool has_fresh_pressure(Time now) const;
  /// Takes the last pressure for that at the surface. @return false: it can be none
  [[nodiscard]] bool zero_at_surface() { return receiver_.zero_at_surface() == Status::kOk; }

  [[nodiscard]] const n2k::Sensors& sensors() const { return receiver_.sensors(); }
  [[nodiscard]] const n2k::NavigationCounters& counters() const { return receiver_.counters(); }
  [[nodiscard]] std::uint64_t fixes() const { return fixes_; }
  [[nodiscard]] std::uint64_t statuses() const { return statuses_; }

 private:
  std::uint8_t port_;
  Duration oldest_part_;
  n2k::NavigationReceiver receiver_;
  n2k::VehicleCondition condition_;
  std::uint64_t fixes_ = 0;
  std::uint64_t statuses_ = 0;
};

}  // namespace earshot::board
