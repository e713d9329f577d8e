#pragma once

#include "firmware/core/units.hpp"

namespace earshot::detector {

/// The paper's basic threshold detector: the source is always heard when SNR >= DT, never below. An SNR that is NaN is no detection.
/// Source: Clark et al. 2022.   Oracle: ThresholdDetector.HearsTheSourceAtExactlyTheThreshold
struct ThresholdDetector {
  Decibels detection_threshold;  ///< DT

  [[nodiscard]] constexpr bool detects(Decibels snr) const { return snr >= detection_threshold; }
};

}  // namespace earshot::detector
