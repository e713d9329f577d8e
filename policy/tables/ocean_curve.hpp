#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "firmware/core/units.hpp"
#include "policy/tables/believed_ocean.hpp"

namespace earshot::tables {

/// SNR against range at the vehicle's depth, in one ocean or in one direction of it.
struct OceanCurve {
  std::string name;            ///< of the ocean
  std::string detail;          ///< what tells the curve from others of that name: " 3 45 deg"
  double weight;               ///< > 0; those of one ocean add up to one
  Meters sea_depth;            ///< of the sea floor at the source
  Meters source_depth;         ///< of the source
  std::vector<double> snr_db;  ///< at range i * CurvePlan::range_step; finite
};

/// Where an ocean is listened to.
struct CurvePlan {
  Meters vehicle_depth;     ///< > 0
  Meters range_step;        ///< > 0
  std::size_t range_count;  ///< >= 2
  std::size_t bearings;     ///< >= 1; of an ocean that differs with place

  [[nodiscard]] Meters furthest() const { return static_cast<double>(range_count - 1) * range_step; }
};

/// Ranges of a table that reaches so far: the first at 0, the last there or beyond. @param furthest  > 0  @param range_step  > 0
[[nodiscard]] double range_count(Meters furthest, Meters range_step);

/// What is heard in an ocean. An ocean that is the same on every bearing gives one curve: the values of sonar::compute_snr_curve at the
/// plan's ranges, as a belief that is told of the ocean has them. One that differs with place gives one for each bearing, from the source
/// outward, and a field library one for each of its positions and bearings, each as likely as another; where there is no water on the way
/// the loss is sonar::kMaxTransmissionLoss, and a bearing without any is left out. None at all: there is no water at the vehicle's depth.
///
/// What a belief makes of that is a reduction: it takes an ocean for the same on all bearings, and weighs these against each other.
/// Throws as sonar::compute_snr_curve and search::soundscape_of do.
/// Oracle: OceanCurve.*
[[nodiscard]] std::vector<OceanCurve> curves_of(const BelievedOcean& ocean, const CurvePlan& plan);

/// The curves of many oceans, in their order. @param progress  told the share that is done  @param without_water  told of each ocean that
/// gave none
[[nodiscard]] std::vector<OceanCurve> curves_of(const std::vector<BelievedOcean>& oceans, const CurvePlan& plan,
                                                const std::function<void(double share)>& progress,
                                                const std::function<void(const BelievedOcean&)>& without_water);

}  // namespace earshot::tables
