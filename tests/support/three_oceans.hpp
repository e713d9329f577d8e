#pragma once

#include <cmath>
#include <memory>

#include "firmware/policy/golden.hpp"
#include "firmware/policy/tables/ocean_tables.hpp"

namespace earshot::support {

/// The golden searches' oceans as tables of a mission in such an area: from 50 dB at the source on, 0.5 dB or 1 dB fainter from one of 128
/// ranges to the next, or with zones.
inline std::unique_ptr<policy::OceanTables> three_oceans(NorthEast area_size, Meters vehicle_depth = Meters{300.0},
                                                         Hertz frequency = Hertz{20.0}) {
  constexpr double kSeaDepth_m = 3'000.0;
  auto tables = std::make_unique<policy::OceanTables>();
  policy::make_golden_tables(area_size, *tables);
  tables->frequency = frequency;
  tables->receiver_depth = vehicle_depth;
  tables->source_depth = {Meters{30.0}, Meters{30.0}};
  tables->sea_depth = {Meters{kSeaDepth_m}, Meters{kSeaDepth_m}};
  for (std::size_t i = 0; i < tables->tables.size(); ++i) tables->tables[i].sea_depth_m = static_cast<float>(kSeaDepth_m);
  return tables;
}

}  // namespace earshot::support
