#include "firmware/safety/track.hpp"

#include <algorithm>

#include "firmware/core/math.hpp"

namespace earshot::safety {

void Track::begin(const messages::Navigation& fix) {
  *this = Track{};
  older_ = fix;
  old_ = fix;
  counted_ = fix.position;
  newest_ = fix;
}

void Track::take(const messages::Navigation& fix) {
  const Radians turned = wrap_to_pi(fix.heading - newest_.heading);
  turned_since_older_ = turned_since_older_ + turned;
  turned_since_old_ = turned_since_old_ + turned;
  newest_ = fix;
  if (fix.time - old_.time >= kBase) {
    older_ = old_;
    turned_since_older_ = turned_since_old_;
    old_ = fix;
    turned_since_old_ = Radians{};
  }
  if (const Duration base = fix.time - older_.time; base >= kBase) {
    const double seconds = base.to_seconds();
    const NorthEast way = fix.position - older_.position;
    velocity_ = NorthEast{.north = way.north / seconds, .east = way.east / seconds};
    turn_rate_ = RadiansPerSecond{std::max(turned_since_older_, -1.0 * turned_since_older_).value / seconds};
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

void Track::correct(const messages::Navigation& fix) {
  counted_ = counted_ + (fix.position - newest_.position);
  older_ = fix;
  old_ = fix;
  turned_since_older_ = Radians{};
  turned_since_old_ = Radians{};
  newest_ = fix;
  if (nearest_) nearest_ = range_between(fix.position, *waypoint_);  // as far as it is from now on: that is no progress
}

void Track::set_waypoint(NorthEast waypoint) {
  waypoint_ = waypoint;
  nearest_.reset();
  came_nearer_ = newest_.time;
}

Duration Track::without_progress(Time now) const {
  return waypoint_ && now > came_nearer_ ? now - came_nearer_ : Duration{};
}

}  // namespace earshot::safety
