#include "policy/command_line/trained_options.hpp"

#include "sim/search/scenario/placement.hpp"

namespace earshot::command_line {
namespace {

std::string name_of(search::StartPlacement start) {
  return std::string(search::kStartPlacements[static_cast<std::size_t>(start)]);
}

/// By name where one says the same: the border may be given another width.
void start_as_trained(ScenarioOptions& options, const description::TrainedTask& task) {
  const std::optional<Meters> margin = task.start_margin;
  if (margin && margin == task.border_width) {
    options.start = name_of(search::StartPlacement::kInsideBorder);
  } else if (margin && margin->value == 0.0) {
    options.start = name_of(search::StartPlacement::kDomain);
  } else if (margin) {
    options.start_margin_m = margin->value;
  } else {
    options.start = name_of(task.start.value_or(search::StartPlacement::kInsideBorder));
  }
}

}  // namespace

ScenarioOptions with_trained(ScenarioOptions given, const description::TrainedTask& task) {
  if (!given.source && task.source) given.source = search::name_of(*task.source);
  if (!given.start && !given.start_margin_m) start_as_trained(given, task);
  if (!given.border_width_m && task.border_width) given.border_width_m = task.border_width->value;
  if (!given.max_steps) given.max_steps = task.max_steps;
  if (!given.vehicle_depth_m && task.vehicle_depth) given.vehicle_depth_m = task.vehicle_depth->value;
  return given;
}

}  // namespace earshot::command_line
