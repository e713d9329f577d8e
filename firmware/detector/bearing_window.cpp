#include "firmware/detector/bearing_window.hpp"

namespace earshot::detector {

BearingWindow::Verdict BearingWindow::take(Time arrival, std::uint8_t port, const messages::BearingMeasurement& measurement,
                                           Duration farthest) {
  if (!messages::is_possible(measurement.bearing) || !lies_within(measurement.time, arrival, farthest)) return Verdict::kRefused;
  const bool is_of_another = held_ && (held_->port != port || held_->newest.sender != measurement.sender);
  if (is_of_another && arrival - held_->arrival <= kBearingHandover) return Verdict::kOfAnother;
  if (held_ && measurement.time < held_->newest.time) return Verdict::kRefused;
  held_ = {.port = port, .arrival = arrival, .newest = measurement};
  if (arrival < measurement.time) held_->newest.time = arrival;
  return Verdict::kTaken;
}

std::optional<messages::Bearing> BearingWindow::heard_after(Time after) const {
  if (!held_ || held_->newest.time <= after || (leg_began_ && held_->newest.time <= *leg_began_)) return std::nullopt;
  return held_->newest.bearing;
}

}  // namespace earshot::detector
