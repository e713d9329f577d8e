#include "firmware/safety/track.hpp"

#include <algorithm>

#include "firmware/core/math.hpp"

namespace earshot::safety {

void Track::begin(const messages::Navigation& fix) {
  *this = Track{};
  older_ = fix;
  old_ = fix;
  counted_ = fix.position;
  newest_ = fix.time;
}

void Track::take(const messages::Navigation& fix) {
  newest_ = fix.time;
  if (fix.time - old_.time >= kBase) {
    older_ = old_;
    old_ = fix;
  }
  if (const Duration base = fix.time - older_.time; base >= kBase) {
    const double seconds = base.to_seconds();
    const NorthEast way = fix.position - older_.position;
    velocity_ = NorthEast{.north = way.north / seconds, .east = way.east / seconds};
    const double turned = wrap_to_pi(fix.heading - older_.heading).value;
    turn_rate_ = RadiansPerSecond{std::max(turned, -turned) / seconds};
    sink_rate_ = MetersPerSecond{(fix.depth - older_.depth).value / seconds};
  }
  if (const Meters way = range_between(counted_, fix.position); way >= kStride) {
    distance_ += way;
    counted_ = fix.position;
  }
  if (!waypoint_) return;
  const Meters left = range_between(fix.position, *waypoint_);
  if (nearest_ && !(left <= *nearest_ - kStride * 0.1)) return;
  nearest_ = left;
  came_nearer_ = fix.time;
}

void Track::set_waypoint(NorthEast waypoint) {
  waypoint_ = waypoint;
  nearest_.reset();
  came_nearer_ = newest_;
}

Duration Track::without_progress(Time now) const {
  return waypoint_ && now > came_nearer_ ? now - came_nearer_ : Duration{};
}

}  // namespace earshot::safety
