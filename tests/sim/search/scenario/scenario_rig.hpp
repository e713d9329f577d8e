#pragma once

#include <string>
#include <vector>

#include "firmware/policy/tables/ocean_tables.hpp"
#include "sim/ocean/file/environment_file.hpp"
#include "sim/sonar/snr_curve.hpp"

namespace earshot::search {

inline const policy::OceanTables kNoOceans;

/// Axis at 1300 m, its scale 1300 m, a perturbation of 0.00737, mud of 1505 m/s, noise of 90 dB; a source of 20 Hz at 30 m.
inline ocean::Environment papers_ocean() {
  return ocean::load_environment(std::string(EARSHOT_SOURCE_DIR) + "/sim/ocean/environments/munk_flat.toml");
}

/// 30 dB at the source, one less per kilometre.
inline sonar::SnrCurve one_decibel_per_kilometer() {
  std::vector<float> snr_db;
  for (int km = 0; km <= 40; ++km) snr_db.push_back(30.0F - static_cast<float>(km));
  return sonar::SnrCurve(Meters{1'000.0}, snr_db);
}

}  // namespace earshot::search
