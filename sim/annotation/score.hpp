#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace earshot::annotation {

/// From begin to end, seconds from the start of the sequence.
struct Interval {
  double begin_s = 0.0;
  double end_s = 0.0;
};

/// How detections compare with what is truly there.
struct Score {
  std::size_t truths = 0;
  std::size_t detections = 0;
  std::size_t hits = 0;  ///< pairs of one of each, each used once
  double hours = 0.0;    ///< that were listened to

  [[nodiscard]] std::size_t misses() const { return truths - hits; }
  [[nodiscard]] std::size_t false_alarms() const { return detections - hits; }
  /// hits / truths; NaN where nothing is there.
  [[nodiscard]] double recall() const;
  /// hits / detections; NaN where nothing was detected.
  [[nodiscard]] double precision() const;
  [[nodiscard]] double false_alarms_per_hour() const;
};

/// As many pairs as there can be of a truth and a detection that overlap or lie at most `tolerance_s` apart, from the end of one to the
/// begin of the other. One detection that is as long as ten truths is one hit, and ten that lie in one truth are one hit and nine false
/// alarms.
///
/// The pairs are found from the left: of all intervals that are left the one that ends first takes, among those that it meets, the one that
/// ends first. (What else it could take meets all that this one meets, so nothing is lost.)
/// Oracle: Score.*, Score.FindsAsManyPairsAsEveryOrderOfPairingCan
/// @param truth, found  in any order
[[nodiscard]] Score score(std::vector<Interval> truth, std::vector<Interval> found, double tolerance_s, double hours);

/// What one threshold gives.
struct OperatingPoint {
  double threshold_db = 0.0;
  Score score;
};

}  // namespace earshot::annotation
