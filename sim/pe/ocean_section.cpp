#include "sim/pe/ocean_section.hpp"

namespace earshot::pe {

Section make_section(const ocean::Section& radial, double water_attenuation_db_per_km) {
  Section section{.floor = {}, .water = {}, .sediment = {}, .water_attenuation_db_per_km = water_attenuation_db_per_km};
  for (const auto& station : radial.sea_floor) section.floor.push_back({station.range.value, station.depth.value});
  for (const auto& station : radial.water) section.water.push_back({station.range.value, station.profile});
  for (const auto& station : radial.sediment) section.sediment.push_back({station.range.value, sediment_points(station.layers)});

  // Sea floor and water are constant up to their first station: one more point says so. Sediment holds backwards by moving its first.
  if (section.floor.front().range_m > 0.0) section.floor.insert(section.floor.begin(), {0.0, section.floor.front().depth_m});
  if (section.water.front().range_m > 0.0) section.water.insert(section.water.begin(), {0.0, section.water.front().profile});
  section.sediment.front().range_m = 0.0;
  return section;
}

Section make_section(const ocean::Environment& environment, Radians bearing, Meters max_range) {
  return make_section(ocean::section_along(environment, environment.source.position, bearing, max_range), environment.absorption_db_per_km);
}

}  // namespace earshot::pe
