#include "sim/ocean/with_source.hpp"

#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/text/numbers.hpp"
#include "sim/ocean/water/sea_water.hpp"

namespace earshot::ocean {

Environment with_source(const Environment& environment, Hertz frequency, Meters depth, const std::string& depth_name) {
  const Meters sea_floor = environment.seabed.depth;
  if (!(depth < sea_floor))
    throw host::BadInput(depth_name + " = " + host::shortest(depth.value) + ": must be less than the depth of the sea floor there, " +
                         host::shortest(sea_floor.value) + " m");
  Environment changed = environment;
  changed.source.frequency = frequency;
  changed.source.depth = depth;
  if (changed.absorbing) {
    changed.absorption_db_per_km = absorption_db_per_km(changed.absorbing->water, changed.absorbing->depth, frequency);
  }
  return changed;
}

}  // namespace earshot::ocean
