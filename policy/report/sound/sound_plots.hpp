#pragma once

#include <string>
#include <vector>

#include "firmware/core/units.hpp"
#include "policy/explain/recorded_decision.hpp"
#include "policy/report/sound/heard_sound.hpp"

namespace earshot::report {

/// What a flight heard, over time, one over the other: the SNR that the vehicle measured and the one that was modelled, with the threshold
/// and the decisions; the spectrogram, with a mark over it wherever a measurement reached the threshold. SVG text to stand in a page.
/// @param sound  is_there()
/// @throws std::runtime_error when gnuplot fails.
[[nodiscard]] std::string sound_svg(const HeardSound& sound, Decibels threshold, const std::vector<explain::RecordedDecision>& decisions);

}  // namespace earshot::report
