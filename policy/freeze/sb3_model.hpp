#pragma once

#include <string_view>

#include "policy/freeze/trained_actor.hpp"

namespace earshot::freeze {

/// Entry of the zip that says what the policy was trained to search; `earshot.gym.sb3.save` (policy/python) writes it.
inline constexpr std::string_view kSearchEntry = "earshot.json";

/// The actor of a model that Stable-Baselines3's save() wrote: PPO or A2C with MlpPolicy, tanh or ReLU, discrete actions. Nothing in the
/// file is executed. Throws host::BadInput for whatever is not certain to be that: another policy class or activation, a feature extractor
/// of its own, weights other than float32.
/// Oracle: Sb3Model.FrozenMakesTheTenThousandDecisionsOfPredict (Stable-Baselines3 2.3.2)
[[nodiscard]] TrainedActor read_sb3_model(std::string_view bytes);

}  // namespace earshot::freeze
