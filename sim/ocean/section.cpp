#include "sim/ocean/section.hpp"

#include <cmath>
#include <sstream>

#include "sim/ocean/stations.hpp"

namespace earshot::ocean {

MetersPerSecond sound_speed(const Section& section, Meters range, Meters depth) {
  const Between at = stations_about(section.water, range);
  const MetersPerSecond below = sound_speed(section.water[at.below].profile, depth);
  if (at.below == at.above) return below;
  return mix(below, sound_speed(section.water[at.above].profile, depth), at.fraction);
}

Meters sea_floor_depth(const Section& section, Meters range) {
  const Between at = stations_about(section.sea_floor, range);
  const Meters below = section.sea_floor[at.below].depth;
  return below + at.fraction * (section.sea_floor[at.above].depth - below);
}

const SedimentStation& sediment_at(const Section& section, Meters range) {
  return section.sediment[stations_about(section.sediment, range).below];
}

std::string to_string(const UnmeasuredWater& water) {
  std::ostringstream text;
  text << water.file << ": temperature and salinity end at " << water.data_end.value << " m, the sea floor lies at "
       << water.sea_floor.value << " m (range " << water.range.value / 1000.0
       << " km); between them the last ones are kept and only pressure raises the sound speed, so that loss may be off by many dB";
  return text.str();
}

}  // namespace earshot::ocean
