#pragma once

#include <functional>
#include <vector>

namespace earshot::oracle {

/// What the textbook scheme is run on: water over one homogeneous sediment.
struct RamCase {
  double frequency_hz;
  double source_depth_m;
  double receiver_depth_m;
  std::function<double(double depth_m)> water_sound_speed_mps;
  std::function<double(double range_m)> floor_depth_m;
  double deepest_m;  ///< of the sea floor; the absorber of 20 wavelengths lies below
  double sediment_sound_speed_mps;
  double sediment_density;
  double sediment_attenuation_db_per_wavelength;
  double range_step_m;
  double depth_step_m;
  int terms;
  double max_range_m;
};

/// Transmission loss at range_step, 2 range_step, ... by RAM 1.5's scheme, plainly: Galerkin elements with the sea floor on the node above,
/// product form of the split-step Pade solution with one stability constraint, self-starter, p / sqrt(rho c) across range.
///
/// Source: Collins, J. Acoust. Soc. Am. 93 (1993) 1736 and 92 (1992) 2069; RAM User's Guide (1999).
[[nodiscard]] std::vector<double> ram_transmission_loss_db(const RamCase& c);

}  // namespace earshot::oracle
