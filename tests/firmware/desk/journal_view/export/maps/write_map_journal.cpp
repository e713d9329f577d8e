// Writes the journal that maps_test.py knows: an area, a fence, two fixes, two decisions.
// usage: write_map_journal FILE BEGAN_S: the clock's seconds when it begins

#include <cstdint>
#include <numbers>
#include <stdexcept>
#include <string>

#include "tests/firmware/host/journal/known_journal.hpp"

namespace {

using namespace earshot;

config::Polygon triangle(double north_m, double east_m, double size_m) {
  config::Polygon corners;
  for (const NorthEast corner : {at(north_m, east_m), at(north_m + size_m, east_m), at(north_m + size_m, east_m + size_m)})
    if (corners.push_back(corner) != Status::kOk) throw std::length_error("corners");
  return corners;
}

messages::MissionRecord mission() {
  messages::MissionRecord record = journal::known_mission();
  config::Safety& safety = record.mission.safety;
  safety.fence = config::Fence{.inside = triangle(300, 200, 900), .save = triangle(200, 100, 1000), .halt = triangle(100, 0, 1100)};
  if (safety.no_surface.push_back(triangle(5000, 5000, 100)) != Status::kOk) throw std::length_error("zones");
  safety.safe_point = at(500, 600);
  return record;
}

messages::Decision decision(std::uint32_t step, Time time) {
  messages::Decision decision;
  decision.step = step;
  decision.time = time;
  decision.position = at(1003, 2004);
  decision.snr = Decibels{12.25};
  decision.detected = true;
  decision.waypoint = at(1003, 1004);
  return decision;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  const Time began{static_cast<std::int64_t>(std::stoll(argv[2])) * 1'000'000};
  const auto time = [began](std::int64_t milliseconds) { return began + Duration::milliseconds(milliseconds); };
  journal::WrittenJournal journal(argv[1]);
  journal.message(began, wire::kMissionChannel, mission());
  const auto fix = [&](std::int64_t milliseconds, NorthEast place, double depth_m) {
    messages::Navigation navigation = journal::known_fix(time(milliseconds));
    navigation.position = place;
    navigation.depth = Meters{depth_m};
    journal.input(time(milliseconds + 50), 1, navigation);
  };
  fix(1000, at(1000, 2000), 299.5);
  fix(2500, at(1003, 2004), 300);
  fix(2000, at(9000, 9000), 10);  // comes late
  messages::Decision first = decision(0, time(2600));
  first.bearing = messages::Bearing{.direction = Radians{std::numbers::pi / 2}, .deviation = Radians{0.25}};
  first.bearing->mirror_axis = Radians{std::numbers::pi / 4};
  first.belief = messages::BeliefSummary{.likeliest = at(4003, 6004), .mean = at(4000, 6000), .spread = Meters{700}};
  journal.message(time(2600), wire::kDecisionChannel, first);
  messages::Decision second = decision(1, time(2700));
  second.too_faint = true;
  second.detected = false;
  second.belief = first.belief;
  second.found.emplace();
  second.found->probability = 0.875F;
  second.found->likeliest = at(4003, 6004);
  journal.message(time(2700), wire::kDecisionChannel, second);
  journal.close({.time = time(3000), .ending = messages::Ending::kMissionOver});
  return 0;
}
