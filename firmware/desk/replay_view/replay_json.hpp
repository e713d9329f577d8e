#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <span>

#include "firmware/boards/linux/replay/replay.hpp"
#include "firmware/desk/replay_view/counterfactual.hpp"
#include "firmware/desk/replay_view/step_pair.hpp"
#include "firmware/host/file/output_file.hpp"

namespace earshot::replay_view {

/// How replay_text() begins.
inline constexpr host::OutputKind kReplayOutput{"a file of earshot replay", {"{\n  \"replay\": {", {}}};

/// What a replay found; times in seconds since the journal began.
[[nodiscard]] nlohmann::ordered_json replay_json(const board::ReplayResult& result, double took_s, std::uint32_t from_step);

/// What another policy or mission decides, from this step on; each decision with the fields of earshot journal --jsonl.
[[nodiscard]] nlohmann::ordered_json what_if_json(const Counterfactual& counterfactual, std::span<const StepPair> pairs,
                                                  std::uint32_t from_step);

/// @param what_if  null: nothing else was asked
[[nodiscard]] std::string replay_text(nlohmann::ordered_json replay, nlohmann::ordered_json what_if);

}  // namespace earshot::replay_view
