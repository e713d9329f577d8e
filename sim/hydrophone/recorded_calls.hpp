#pragma once

#include <filesystem>

#include "firmware/detector/hydrophone/settings.hpp"
#include "sim/hydrophone/calls.hpp"

namespace earshot::hydrophone {

/// So much of a longer file is heard again and again.
inline constexpr double kMostRecorded_s = 3600.0;

/// The first channel of a sound file as what a source sends out, filtered to what the detector listens to. The loudest integration time
/// that the detector finds in its band has a root mean square of 1: it is received at the level of the sonar equation, all else of the file
/// as much fainter as it is there. Its noise comes with it.
/// @param listening  check() has found no fault
/// Throws host::BadInput naming the file when it cannot be read, is shorter than an integration time, holds a sample that is no number, or
/// no sound that the detector could hear.
/// Oracle: RecordedCalls.*
[[nodiscard]] Recording load_calls(const std::filesystem::path& file, const detector::SoundSettings& listening);

}  // namespace earshot::hydrophone
