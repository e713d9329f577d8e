#pragma once

#include <cstddef>
#include <vector>

#include "firmware/core/units.hpp"
#include "sim/ocean/environment.hpp"
#include "sim/pe/options.hpp"
#include "sim/sonar/radial.hpp"
#include "sim/sonar/snr_curve.hpp"

namespace earshot::sonar {

/// -10 log10 |p|^2, dB re 1 m, for a source of unit pressure at 1 m; at most `kMaxTransmissionLoss`, also where the pressure vanishes.
[[nodiscard]] Decibels transmission_loss(double squared_pressure);

inline constexpr Decibels kMaxTransmissionLoss{300.0};

/// What a hydrophone hears of the environment's source on one radial, against range and depth; NaN where there is no water.
struct SonarField {
  std::vector<double> range_m;                ///< increasing, > 0
  std::vector<double> depth_m;                ///< positive down
  Decibels source_level;                      ///< dB re 1 uPa @ 1 m
  Decibels noise_level;                       ///< in the detector's band, dB re 1 uPa
  std::vector<float> transmission_loss_db;    ///< [n_range x n_depth], dB re 1 m
  std::vector<float> sea_floor_depth_m = {};  ///< [n_range]; 0 on land

  [[nodiscard]] float at(std::size_t range, std::size_t depth) const { return transmission_loss_db[range * depth_m.size() + depth]; }
  /// SL - TL - N at one range and depth; NaN where there is no water.
  [[nodiscard]] float snr_db(std::size_t range, std::size_t depth) const;
};

/// The radial of `bearing` (clockwise from north) from the environment's source. Throws as compute_radial does.
[[nodiscard]] SonarField compute_sonar_field(const ocean::Environment& environment, Radians bearing, const RadialPlan& plan,
                                             const pe::Progress& progress = {});

/// SNR at one receiver depth every 10 m of range up to `max_range`. Range 0 gets the value at 10 m; where there is no water the loss is
/// `kMaxTransmissionLoss`.
///
/// Throws as compute_radial does, and std::invalid_argument where the ocean differs from bearing to bearing: that needs a Fan; and for a
/// receiver that is nowhere above the sea floor, naming both depths.
/// Oracle: SonarField.CurveFollowsTheReferenceOfThePapersOcean
[[nodiscard]] SnrCurve compute_snr_curve(const ocean::Environment& environment, Meters receiver_depth, Meters max_range);

}  // namespace earshot::sonar
