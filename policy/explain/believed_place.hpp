#pragma once

#include <cstddef>
#include <vector>

#include "firmware/core/geometry.hpp"
#include "firmware/core/units.hpp"
#include "firmware/policy/ocean_belief/ocean_belief.hpp"

namespace earshot::explain {

/// One standard deviation about the mean place, along its longest and its shortest direction.
struct SpreadEllipse {
  Meters semi_major;
  Meters semi_minor;
  Radians bearing;  ///< of the longest direction, clockwise from north, in [0, pi)
};

/// The place where a belief puts the source, in the numbers that a chart needs. Places are relative to the area's south-west corner.
struct BelievedPlace {
  NorthEast area_size;
  std::size_t cells_north = 0;
  std::size_t cells_east = 0;
  std::vector<double> probability;  ///< [north x east]
  std::vector<double> rank;         ///< [north x east] probability of the smallest area that holds this cell and all likelier ones, 0 to 1
  NorthEast likeliest;              ///< centre of the likeliest cell
  double likeliest_share = 0.0;
  NorthEast mean;
  SpreadEllipse ellipse;

  [[nodiscard]] NorthEast centre(std::size_t north, std::size_t east) const;
  /// Square kilometres of the smallest area that holds the source with the given probability.
  [[nodiscard]] double smallest_area_km2(double share) const;
};

[[nodiscard]] BelievedPlace believed_place(const policy::OceanBelief& belief, const policy::BeliefModel& model);

/// The SNR that would be heard at a place if the belief were the truth.
struct ExpectedHearing {
  Decibels snr;         ///< mean over places and hypotheses
  Decibels spread;      ///< standard deviation over places alone, without what measuring adds
  Decibels level_bias;  ///< the part of `snr` that the hypotheses about the source's level make
};

/// By how much a step is expected to shorten the distance to the source, metres; negative when it leads away.
[[nodiscard]] Meters expected_approach(const BelievedPlace& place, NorthEast from, NorthEast to);

/// What is expected of a source at every range, over all hypotheses that a belief retains: each as likely as it now is, wherever the
/// source.
class ExpectedSound {
 public:
  ExpectedSound(const policy::OceanBelief& belief, const policy::OceanTables& tables);

  /// Mean SNR at a range, the level's part in it; between two ranges of the tables by the straight line.
  [[nodiscard]] double snr_db(Meters range) const;
  /// The part of it that the hypotheses about the source's level make.
  [[nodiscard]] double level_db() const { return level_db_; }

 private:
  Meters range_step_;
  std::vector<double> snr_db_;  ///< [ranges]
  double level_db_ = 0.0;
};

/// Oracle: ExpectedHearing.IsTheMeanOfTheTableOverTheCells
[[nodiscard]] ExpectedHearing expected_hearing(const BelievedPlace& place, const ExpectedSound& sound, NorthEast at);

}  // namespace earshot::explain
