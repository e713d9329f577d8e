#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "policy/explain/decision_account.hpp"

namespace earshot::report {

// One decision in words: what a report and the page of its flight have in common.

/// Whether a network chose: only then is there something that moved its choice.
[[nodiscard]] bool has_network(const explain::DecisionAccount& account);

/// Of the directions that were not taken the one that the policy made most of.
[[nodiscard]] std::optional<std::size_t> second_best(const explain::DecisionAccount& account);

/// Sentences that a watch officer reads first: measured, believed, why this direction, chosen, expected, safety; of a sweep why it sweeps.
[[nodiscard]] std::vector<std::string> sentences(const explain::DecisionAccount& account);

/// One of them: why this direction and not the next best. First whether both are nearly equal, and what the policy made of them; then
/// where the source is believed to be, what speaks for the direction, the strongest first, and what for the other.
[[nodiscard]] std::string why_this_direction(const explain::DecisionAccount& account);

/// Another, of a trained policy: which of its observations weighed most.
[[nodiscard]] std::string what_weighed_most(const explain::DecisionAccount& account);

/// Whether the policy takes its likeliest direction or draws lots, and how high it rated the one taken.
[[nodiscard]] std::string choice_sentence(const explain::DecisionAccount& account);

/// What a table of observations shows, in one sentence that stands above it.
inline constexpr const char* kPartsMean =
    "How much each number that the policy received moved the choice, by integrated gradients of the natural logarithm of the probability "
    "of the direction taken: a part of 0.69 doubles the probability, one of -0.69 halves it.";

/// "a vehicle in the middle of the area that has heard nothing yet"
[[nodiscard]] std::string to_string(explain::Baseline baseline);

/// "the parts add up to 1.2340 of 1.2344 after 64 steps, complete within 0.001"
[[nodiscard]] std::string completeness_to_string(const explain::Attribution& attribution);

/// "9.5 dB", "under 5.0 dB", "9.5 dB from 047° ± 10°"
[[nodiscard]] std::string to_string(const policy::Reception& reception);
/// "047° ± 10°", and its mirror image where left and right cannot be told apart.
[[nodiscard]] std::string to_string(const messages::Bearing& bearing);

/// Every direction as a table of Markdown: its score or how likely it was, what the policy ranked it by, what it would be expected to
/// bring, and what each column means.
[[nodiscard]] std::string actions_markdown(const explain::DecisionAccount& account);

}  // namespace earshot::report
