#pragma once

#include "sim/netcdf/conventions.hpp"

namespace earshot::sonar {

// What files and Python say of the levels that are computed.

[[nodiscard]] inline netcdf::Attributes transmission_loss_attributes() {
  return netcdf::level_attributes("transmission loss", netcdf::kReOneMeter);
}
[[nodiscard]] inline netcdf::Attributes snr_attributes() {
  return netcdf::level_attributes("signal-to-noise ratio at the hydrophone", netcdf::kRatio);
}
[[nodiscard]] inline netcdf::Attributes source_level_attributes() {
  return netcdf::level_attributes("source level", netcdf::kReOneMicropascalAtOneMeter);
}
[[nodiscard]] inline netcdf::Attributes noise_level_attributes() {
  return netcdf::level_attributes("noise level in the detector's band", netcdf::kReOneMicropascal);
}

}  // namespace earshot::sonar
