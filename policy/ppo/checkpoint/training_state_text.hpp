#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

#include "policy/ppo/trainer.hpp"

namespace earshot::ppo {

[[nodiscard]] nlohmann::ordered_json to_json(const TrainingState& state);
/// Throws nlohmann::json::exception when something is missing or of another type. That it fits a training, Trainer::resume finds out.
[[nodiscard]] TrainingState training_state_from(const nlohmann::ordered_json& json);

/// One rank's part as text, to send to the rank that writes.
[[nodiscard]] std::string to_text(const WorkerState& worker);
[[nodiscard]] WorkerState worker_from_text(std::string_view text);

}  // namespace earshot::ppo
