#include "policy/description/state.hpp"

#include <algorithm>
#include <array>
#include <cassert>

#include "sim/search/belief_model.hpp"

namespace earshot::description {
namespace {

policy::ObservationSpec memory(std::size_t steps, const search::SearchSettings& s) {
  return policy::memory_state(steps, s.step_length, s.detection_threshold).value();
}

policy::ObservationSpec position_memory(std::size_t steps, const search::SearchSettings& s) {
  policy::ObservationSpec spec = policy::simple_state(s.domain.north_east - s.domain.south_west);
  for (const policy::ObservationElement& element : memory(steps, s)) {
    [[maybe_unused]] const Status status = spec.push_back(element);
    assert(status == Status::kOk);
  }
  return spec;
}

}  // namespace

std::string_view name_of(State state) {
  return kStates[static_cast<std::size_t>(state)];
}

std::string_view what_is_observed(State state) {
  constexpr std::array<std::string_view, kStates.size()> kObserved{"its place", "the SNR of its last steps", "its belief about the source",
                                                                   "its place and the SNR of its last steps"};
  return kObserved[static_cast<std::size_t>(state)];
}

std::optional<State> state_named(std::string_view name) {
  const auto* const found = std::ranges::find(kStates, name);
  if (found == kStates.end()) return std::nullopt;
  return static_cast<State>(found - kStates.begin());
}

bool remembers(State state) {
  return state == State::kMemory || state == State::kPositionMemory;
}

std::size_t most_remembered(State state) {
  constexpr std::size_t kElements = 3;  // of a remembered step
  constexpr std::size_t kPosition = 2;
  const std::size_t room = config::kMaxObservation - (state == State::kPositionMemory ? kPosition : 0);
  return std::min(config::kMaxRememberedSteps, room / kElements);
}

policy::ObservationModel observation_of(State state, std::size_t remembered_steps, const search::SearchSettings& settings) {
  policy::ObservationModel model;
  model.listening = settings.listening;
  model.belief = search::belief_model(settings);
  switch (state) {
    case State::kSimple:
      model.spec = policy::simple_state(settings.domain.north_east - settings.domain.south_west);
      break;
    case State::kMemory:
      model.spec = memory(remembered_steps, settings);
      break;
    case State::kBelief:
      model.spec = policy::belief_state(model.belief);
      break;
    case State::kPositionMemory:
      model.spec = position_memory(remembered_steps, settings);
      break;
  }
  return model;
}

}  // namespace earshot::description
