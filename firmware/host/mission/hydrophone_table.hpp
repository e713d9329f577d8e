#pragma once

#include "firmware/config/mission.hpp"
#include "firmware/core/time.hpp"
#include "firmware/detector/hydrophone/settings.hpp"
#include "firmware/host/toml/table_reader.hpp"

namespace earshot::host {

/// Reads a mission's table `hydrophone`: the chain from water to numbers, and what is listened for. What is wrong is noted, also what the
/// detector's check() finds, and what could not hear what the mission searches for: a band without its frequency, a gate that is closed at
/// its speed, a chain in which the sea clips or is less than the ADC's own noise.
/// @param search   table with the mission's threshold, frequency and speed, where the threshold is complained of
/// @param mission  its search as it was read: what counts as heard, at what frequency and speed, is said in one place
[[nodiscard]] detector::SoundSettings read_hydrophone(TableReader hydrophone, TableReader search, const config::Mission& mission);

/// How old a measurement may become while nothing is wrong but one lost block: what has been heard before it, the filters' beginning, one
/// integration time until the next measurement, and the filters' delay. @pre check(settings) finds no fault
[[nodiscard]] Duration longest_silence_of(const detector::SoundSettings& settings);

}  // namespace earshot::host
