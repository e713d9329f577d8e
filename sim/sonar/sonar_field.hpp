#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "firmware/core/units.hpp"
#include "sim/ocean/environment.hpp"
#include "sim/ocean/section.hpp"
#include "sim/pe/options.hpp"
#include "sim/pe/solver.hpp"
#include "sim/sonar/radial.hpp"
#include "sim/sonar/snr_curve.hpp"

namespace earshot::sonar {

inline constexpr Decibels kMaxTransmissionLoss{300.0};

/// -10 log10 |p|^2, dB re 1 m, for a source of unit pressure at 1 m; at most `kMaxTransmissionLoss`, also where the pressure vanishes.
[[nodiscard]] inline Decibels transmission_loss(double squared_pressure) {
  constexpr double kDecibelsPerDoubling = 10.0 * std::numbers::ln2 / std::numbers::ln10;  // the C library's log10 is slower than its log2
  // Written so that zero pressure, infinite loss, ends at the cap.
  return Decibels{std::min(-kDecibelsPerDoubling * std::log2(squared_pressure), kMaxTransmissionLoss.value)};
}

/// What a hydrophone hears of the environment's source on one radial, against range and depth; NaN where there is no water.
struct SonarField {
  std::vector<double> range_m;                            ///< increasing, > 0
  std::vector<double> depth_m;                            ///< positive down
  Decibels source_level;                                  ///< dB re 1 uPa @ 1 m
  Decibels noise_level;                                   ///< in the detector's band, dB re 1 uPa
  std::vector<float> transmission_loss_db;                ///< [n_range x n_depth], dB re 1 m
  std::vector<float> sea_floor_depth_m = {};              ///< [n_range]; 0 on land
  std::optional<ocean::UnmeasuredWater> unmeasured = {};  ///< what of the radial's water was not measured but extended, if any

  std::vector<std::complex<double>> pressure = {};  ///< empty, or [n_range x n_depth] as of RadialLoss
  std::optional<pe::MarchGrid> grid = {};           ///< nothing where there was nothing to march through

  [[nodiscard]] float at(std::size_t range, std::size_t depth) const { return transmission_loss_db[range * depth_m.size() + depth]; }
  /// SL - TL - N at one range and depth; NaN where there is no water.
  [[nodiscard]] float snr_db(std::size_t range, std::size_t depth) const;
};

/// What must be known of a field whose error is predicted to be much larger than what was asked for: pe::doubt_of.
[[nodiscard]] std::optional<std::string> doubt_of(const SonarField& field, Decibels accuracy);

/// To 1/256 dB, as files hold it.
[[nodiscard]] std::vector<float> rounded_loss_db(std::vector<float> loss_db);

/// SL - TL - N of the rounded loss, as files hold it. [n_range x n_depth], NaN where there is no water
[[nodiscard]] std::vector<float> rounded_snr_db(const SonarField& field);

enum class Pressure : bool { kLeftOut, kKept };

/// A radial from the environment's source. Throws as compute_radial does.
/// @param section   of the radial, as far as the plan goes
/// @param pressure  is kept of a band without width alone
[[nodiscard]] SonarField compute_sonar_field(const ocean::Environment& environment, const ocean::Section& section, const RadialPlan& plan,
                                             const pe::Progress& progress = {}, Pressure pressure = Pressure::kLeftOut);

/// SNR at one receiver depth every 10 m of range up to `max_range`. Range 0 gets the value at 10 m; where there is no water the loss is
/// `kMaxTransmissionLoss`.
///
/// Throws as ocean::section_along and compute_radial do, and std::invalid_argument where the ocean differs from bearing to bearing: that
/// needs a Fan; and for a receiver that is nowhere above the sea floor, naming both depths. Oracle:
/// SonarField.CurveFollowsTheReferenceOfThePapersOcean
[[nodiscard]] SnrCurve compute_snr_curve(const ocean::Environment& environment, Meters receiver_depth, Meters max_range);

}  // namespace earshot::sonar
