#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "firmware/core/time.hpp"
#include "firmware/desk/replay_view/counterfactual.hpp"
#include "firmware/desk/replay_view/step_pair.hpp"

namespace earshot::replay_view {

/// A row for every step from this one on: when, at which SNR, towards where and to which way-point, then and now. From the row on that says
/// "parts" the inputs are those of a vehicle that followed the journal.
[[nodiscard]] std::string decision_table(std::span<const StepPair> pairs, std::uint32_t from_step, Time began);

/// Where the decisions part, in a sentence: "the decisions part at step 3: ...", which may be before the steps that are listed.
[[nodiscard]] std::string where_they_part(std::span<const StepPair> pairs, std::uint32_t from_step, Time began);

/// From when on the set-points differ, how both missions stood at the end of what was given again, and what all of it is worth; lines.
[[nodiscard]] std::string what_it_means(const Counterfactual& counterfactual, std::span<const StepPair> pairs);

}  // namespace earshot::replay_view
