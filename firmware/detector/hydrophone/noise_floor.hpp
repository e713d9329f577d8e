#pragma once

#include <array>
#include <cstddef>

#include "firmware/config/capacities.hpp"

namespace earshot::detector {

/// The mean power of noise, from powers of noise and calls together: their running median, corrected to the mean that noise of that median
/// has. Calls do not lift it as long as they fill less than half of its memory: of a share c of calls, it reads as the noise's own quantile
/// 0.5 / (1 - c), 0.3 dB too high for a tenth and 0.8 dB for a quarter at 30 degrees of freedom. The share is that of powers that hold any
/// of a call: one as long as a power's time lies in two of them, and counts twice.
///
/// Time constant: after a step of the noise it is the new noise's once half of its memory is new.
/// Source: an order statistic in place of the mean, as in Rohling 1983, Radar CFAR thresholding in clutter and multiple target situations,
/// IEEE Trans. Aerosp. Electron. Syst. 19.   Oracle: NoiseFloor.*
class NoiseFloor {
 public:
  /// Forgets everything.
  /// @param memory  powers remembered, 1 to config::kFloorLevels; degrees_of_freedom  of one of them
  void configure(std::size_t memory, double degrees_of_freedom);

  /// @param power  finite, not negative
  void take(float power);

  /// How many powers it knows, memory at most.
  [[nodiscard]] std::size_t known() const { return size_; }
  /// Mean power of the noise; zero where nothing is known.
  [[nodiscard]] double power() const { return power_; }

 private:
  void insert(float power);
  void remove(float power);
  void estimate();

  std::array<float, config::kFloorLevels> ring_{};
  std::array<float, config::kFloorLevels> sorted_{};
  std::size_t memory_ = 1;
  std::size_t size_ = 0;
  std::size_t oldest_ = 0;
  double degrees_of_freedom_ = 1.0;
  double power_ = 0.0;
};

}  // namespace earshot::detector
