#pragma once

#include <string>

#include "firmware/boards/linux/hydrophone/hydrophone_processor.hpp"
#include "firmware/detector/hydrophone/settings.hpp"

namespace earshot::board {

/// "it heard 118 s of 120 s of sound: 112 measurements, 3 of them too faint to measure, and 2 detections; not heard: 2 s, has just begun",
/// with what to do about each.
[[nodiscard]] std::string to_string(const HydrophoneProcessor::Account& account);

/// "hears 15 to 30 Hz; a sample of full scale is 180.0 dB re 1 uPa, less what gain its blocks name"
[[nodiscard]] std::string to_string(const detector::SoundSettings& settings);

}  // namespace earshot::board
