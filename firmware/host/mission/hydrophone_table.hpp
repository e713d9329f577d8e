#pragma once

#include "firmware/core/time.hpp"
#include "firmware/core/units.hpp"
#include "firmware/detector/hydrophone/settings.hpp"
#include "firmware/host/toml/table_reader.hpp"

namespace earshot::host {

/// Reads a mission's table `hydrophone`: the chain from water to numbers, and what is listened for. What is wrong is noted, also what the
/// detector's check() finds.
/// @param search               table with the key `detection_threshold_db`, where the threshold is complained of
/// @param detection_threshold  the mission's own: what counts as heard is said in one place
[[nodiscard]] detector::SoundSettings read_hydrophone(TableReader hydrophone, TableReader search, Decibels detection_threshold);

/// How old a look may become while nothing is wrong but one lost block: what has been heard before it, the filters' beginning, one
/// integration time until the next look, and the filters' delay. @pre check(settings) finds no fault
[[nodiscard]] Duration longest_silence_of(const detector::SoundSettings& settings);

}  // namespace earshot::host
