#include "sim/ocean/with_source.hpp"

#include "sim/ocean/water/sea_water.hpp"

namespace earshot::ocean {

Environment with_source(const Environment& environment, Hertz frequency, Meters depth) {
  Environment changed = environment;
  changed.source.frequency = frequency;
  changed.source.depth = depth;
  if (changed.absorbing) {
    changed.absorption_db_per_km = absorption_db_per_km(changed.absorbing->water, changed.absorbing->depth, frequency);
  }
  return changed;
}

}  // namespace earshot::ocean
