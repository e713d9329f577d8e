#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "firmware/config/capacities.hpp"
#include "firmware/core/time.hpp"
#include "firmware/core/units.hpp"
#include "firmware/detector/hydrophone/estimate.hpp"
#include "firmware/detector/hydrophone/listening_plan.hpp"
#include "firmware/detector/hydrophone/settings.hpp"

namespace earshot::detector {

/// Where a sound begins and ends: from the first to the last quarter of an integration time that is no more than 10 dB under the loudest,
/// so that what leads up to a loud call does not count as its beginning, and louder than noise alone but once in a hundred quarters, so
/// that noise around a weak call does not count as the call. What is within 3 dB of the loudest always counts.
class Extent {
 public:
  /// @param noise  P / N that noise alone hardly ever reaches in a quarter
  explicit Extent(double noise = 0.0) : noise_(noise) {}
  void clear() { *this = Extent(noise_); }
  /// @param end  of the quarter; quarters come one after the other
  void take(Time end, double power);
  [[nodiscard]] Time begin(Duration quarter) const { return Time{size_ == 0 ? 0 : rises_[0].end.us - quarter.us}; }
  [[nodiscard]] Time end() const { return end_; }

 private:
  struct Rise {
    Time end;
    double power = 0.0;
  };
  /// What a quarter must reach to belong to a sound whose loudest is `loudest`.
  [[nodiscard]] double limit(double loudest) const;

  double noise_;
  std::array<Rise, config::kExtentRises> rises_{};  ///< each louder than all before, at the limit or above
  std::size_t size_ = 0;
  Time end_;
  double loudest_ = 0.0;
};

/// From estimates to detections. One begins when `m` of the last `n` estimates reach the threshold, and goes on until for longer than the
/// longest pause no estimate came within 6 dB of it: a call that fluctuates is one. At thresholds below 6 dB it
/// goes on as long as it is as loud as the noise (0 dB): noise alone does not keep it going. What is in the way of hearing counts as a
/// pause.
class DetectionTracker {
 public:
  /// How far under the threshold a detection still goes on.
  static constexpr Decibels kHysteresis{6.0};

  void configure(const SoundSettings& settings);
  /// Forgets the detection under way.
  void clear();
  /// @param degrees_of_freedom  of the noise's power over an integration time
  void set_quarter(Duration quarter, double degrees_of_freedom);

  /// @param estimate  complete but for `ended`; quarter_ratios  P / N of its four quarters, the oldest first
  /// @return the detection that it ends
  [[nodiscard]] std::optional<Detection> take(const Estimate& estimate, const std::array<double, kQuarters>& quarter_ratios);

  /// The detection that has not ended, as if it did.
  [[nodiscard]] std::optional<Detection> finish();

 private:
  [[nodiscard]] bool is_enough(bool reaches);
  [[nodiscard]] bool is_held(double ratio) const;
  void extend(const Estimate& estimate);

  Decibels threshold_{10.0};
  MOfN m_of_n_;
  Duration longest_pause_;
  Duration quarter_;
  std::uint32_t reached_ = 0;           ///< one bit for each of the last 32 estimates, the newest lowest
  std::optional<Detection> detection_;  ///< under way, or, until enough estimates reached the threshold, what may become one
  bool is_enough_ = false;
  Extent extent_;
  Time last_held_;  ///< the last estimate within the hysteresis
};

}  // namespace earshot::detector
