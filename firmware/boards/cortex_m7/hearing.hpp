#pragma once

#include "earshot/hearing_t.hpp"
#include "firmware/core/time.hpp"
#include "firmware/detector/hydrophone/settings.hpp"

namespace earshot::board {

// What a microcontroller listens for, as it is told over its serial line: to_settings(to_message(settings, time)) are the same settings.

[[nodiscard]] hearing_t to_message(const detector::SoundSettings& settings, Time time);
/// Judges nothing: detector::check() does.
[[nodiscard]] detector::SoundSettings to_settings(const hearing_t& message);

}  // namespace earshot::board
