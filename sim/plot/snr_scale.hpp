#pragma once

#include <string>

#include "firmware/core/units.hpp"

namespace earshot::plot {

/// gnuplot's commands for the scale that every map and field shows SNR on, so that pictures can be laid side by side: from 20 dB below
/// the detection threshold to 30 dB above it, cold below the threshold and warm above, where the colours part is the edge of detection.
/// Oracle: SnrScale.*
[[nodiscard]] std::string snr_scale(Decibels detection_threshold);

}  // namespace earshot::plot
