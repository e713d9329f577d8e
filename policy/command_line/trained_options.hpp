#pragma once

#include "policy/command_line/scenario_options.hpp"
#include "policy/description/trained_task.hpp"

namespace earshot::command_line {

/// The options that were given, and where one was not what a policy was trained for, if that is known: source, starts, border's width,
/// steps, depth. Starts that are not known lie inside the border. The environment stays: a policy is tested in other oceans than it learned
/// in. Oracle: TrainedOptions.*
[[nodiscard]] ScenarioOptions with_trained(ScenarioOptions given, const description::TrainedTask& task);

}  // namespace earshot::command_line
