#pragma once

#include <Eigen/Core>
#include <complex>
#include <cstddef>
#include <vector>

#include "firmware/core/units.hpp"
#include "sim/ocean/environment.hpp"
#include "sim/pe/solver.hpp"
#include "sim/sonar/snr_curve.hpp"

namespace earshot::sonar {

/// -20 log10 |p|, dB re 1 m, for a source of unit pressure at 1 m; at most `kMaxTransmissionLoss`, also where the pressure vanishes.
[[nodiscard]] Decibels transmission_loss(std::complex<double> pressure);

inline constexpr Decibels kMaxTransmissionLoss{300.0};

using DecibelArray = Eigen::Array<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// What a hydrophone hears of the environment's source, against range and depth.
struct SonarField {
  std::vector<double> range_m;        ///< increasing, > 0
  std::vector<double> depth_m;        ///< positive down
  DecibelArray transmission_loss_db;  ///< [n_range x n_depth], dB re 1 m
  DecibelArray snr_db;                ///< [n_range x n_depth]
};

/// @param receiver_depth_m  each in the water
/// Throws as pe::solve does.
[[nodiscard]] SonarField compute_sonar_field(const ocean::Environment& environment, const pe::Options& options,
                                             const std::vector<double>& receiver_depth_m, Meters max_range,
                                             const pe::Progress& progress = {});

/// SNR at one receiver depth every 10 m of range up to `max_range`. Range 0 gets the value at 10 m.
///
/// Throws as pe::solve does.
/// Oracle: SonarField.CurveFollowsTheReferenceOfThePapersOcean
[[nodiscard]] SnrCurve compute_snr_curve(const ocean::Environment& environment, Meters receiver_depth, Meters max_range);

}  // namespace earshot::sonar
