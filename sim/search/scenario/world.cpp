#include "sim/search/scenario/world.hpp"

namespace earshot::search {

World assemble(const Scenario& scenario, const SearchSettings& settings, Meters vehicle_depth, Meters furthest) {
  return {settings, soundscape_of(scenario, vehicle_depth, furthest), scenario.conditions};
}

World assemble(const Scenario& scenario, const SearchSettings& settings, Meters vehicle_depth) {
  return assemble(scenario, settings, vehicle_depth, furthest_range(settings));
}

}  // namespace earshot::search
