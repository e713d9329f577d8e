#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "firmware/core/geometry.hpp"
#include "firmware/core/units.hpp"
#include "sim/ocean/sound_speed.hpp"

namespace earshot::ocean {

/// A uniform fluid sediment.
struct SedimentLayer {
  Meters thickness;                            ///< > 0; the last layer is a half-space and its thickness is not used
  MetersPerSecond sound_speed;                 ///< > 0
  double density_g_per_cm3 = 1.5;              ///< > 0; the water's is 1
  double attenuation_db_per_wavelength = 0.5;  ///< >= 0
};

struct Seabed {
  Meters depth;                       ///< of the sea floor, > 0
  std::vector<SedimentLayer> layers;  ///< from the sea floor down, at least one
};

struct Source {
  Hertz frequency;     ///< > 0
  Decibels level;      ///< dB re 1 uPa @ 1 m
  Meters depth;        ///< in the water
  NorthEast position;  ///< in the plane of the search domain
};

/// One ocean and the source in it; the same in every direction and at every range.
struct Environment {
  std::string name;
  SoundSpeedProfile water;
  Seabed seabed;
  Source source;
  Decibels noise_level;          ///< in the detector's band, dB re 1 uPa
  std::uint32_t file_crc32 = 0;  ///< CRC-32 of the bytes of the file this was read from, for provenance; 0 when it came from none
};

}  // namespace earshot::ocean
