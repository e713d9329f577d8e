#include "firmware/desk/checklist/budgets.hpp"

#include <algorithm>

#include "firmware/safety/measures.hpp"

namespace earshot::board {
namespace {

double percent_for(const config::Mission& mission, Meters way) {
  return way.value * 1e-3 * mission.safety.vehicle.battery_percent_per_km;
}

}  // namespace

Meters way_of_all_steps(const config::Mission& mission) {
  return mission.step_length * mission.max_steps;
}

double seconds_for_all_steps(const config::Mission& mission) {
  return way_of_all_steps(mission).value / mission.search_speed.value;
}

double seconds_against_current(const config::Mission& mission) {
  return safety::against_current(mission, way_of_all_steps(mission)).value / mission.search_speed.value;
}

double percent_for_all_steps(const config::Mission& mission) {
  return percent_for(mission, way_of_all_steps(mission));
}

Meters longest_way_home(const config::Mission& mission) {
  Meters longest;
  const Rectangle& r = mission.operating_area;
  for (const NorthEast corner :
       {r.south_west, NorthEast{r.north_east.north, r.south_west.east}, r.north_east, NorthEast{r.south_west.north, r.north_east.east}})
    longest = std::max(longest, range_between(corner, *mission.safety.safe_point));
  return longest;
}

double percent_for_way_home(const config::Mission& mission) {
  return percent_for(mission, safety::against_current(mission, longest_way_home(mission)));
}

}  // namespace earshot::board
