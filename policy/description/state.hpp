#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "firmware/policy/observation.hpp"
#include "sim/search/settings.hpp"

namespace earshot::description {

/// The observations that training and Python offer.
enum class State : std::uint8_t {
  kSimple,          ///< o = (x, y)
  kMemory,          ///< displacement and SNR of each of the last steps
  kBelief,          ///< what is believed about the source, from all that was heard
  kPositionMemory,  ///< kSimple and kMemory together
};

/// Names of the states, in their order.
inline constexpr std::array<std::string_view, 4> kStates{"simple", "memory", "belief", "position_memory"};
[[nodiscard]] std::string_view name_of(State state);
/// What a policy observes, as people read it: "its place".
[[nodiscard]] std::string_view what_is_observed(State state);
/// Nothing for a name that is none of kStates.
[[nodiscard]] std::optional<State> state_named(std::string_view name);

/// Whether a state shows remembered steps.
[[nodiscard]] bool remembers(State state);
/// The most remembered steps that fit into an observation of that state.
[[nodiscard]] std::size_t most_remembered(State state);

/// The observation that a state stands for, and the model of the search that a belief takes for granted.
/// @param remembered_steps  m, 1 to most_remembered(state); ignored where the state shows none
[[nodiscard]] policy::ObservationModel observation_of(State state, std::size_t remembered_steps, const search::SearchSettings& settings);

}  // namespace earshot::description
