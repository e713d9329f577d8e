#include "firmware/wire/n2k/own/hull_alarms.hpp"

#include <algorithm>

namespace earshot::n2k {

bool HullAlarms::is_of(const Alarm& alarm, const Alarm& other) {
  if (alarm.instance != other.instance) return false;
  return alarm.name ? alarm.name == other.name : alarm.source == other.source;
}

HullAlarms::Alarm& HullAlarms::place_of(const Alarm& alarm) {
  const auto known = std::ranges::find_if(alarms_, [&](const Alarm& other) { return !other.is_over() && is_of(other, alarm); });
  if (known != alarms_.end()) return *known;
  const auto free = std::ranges::find_if(alarms_, [](const Alarm& other) { return other.is_over(); });
  return free != alarms_.end() ? *free : unplaced_;
}

void HullAlarms::take(const Hull& hull, std::uint8_t source, const Directory& directory) {
  Alarm alarm{.source = source, .name = directory.name_of(source), .instance = hull.instance};
  Alarm& place = place_of(alarm);
  alarm.wet = hull.wet.value_or(place.wet);
  alarm.ground_fault = hull.has_ground_fault.value_or(place.ground_fault);
  if (&place != &unplaced_) {
    place = alarm;
    return;
  }
  unplaced_.wet = unplaced_.wet || alarm.wet;
  unplaced_.ground_fault = unplaced_.ground_fault || alarm.ground_fault;
}

bool HullAlarms::has_leak() const {
  return unplaced_.wet || std::ranges::any_of(alarms_, [](const Alarm& alarm) { return alarm.wet; });
}

bool HullAlarms::has_ground_fault() const {
  return unplaced_.ground_fault || std::ranges::any_of(alarms_, [](const Alarm& alarm) { return alarm.ground_fault; });
}

}  // namespace earshot::n2k
