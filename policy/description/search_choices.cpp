#include "policy/description/search_choices.hpp"

#include "sim/search/scenario/placement.hpp"

namespace earshot::description {
namespace {

std::string name_of(search::StartPlacement start) {
  return std::string(search::kStartPlacements[static_cast<std::size_t>(start)]);
}

/// By name where one says the same: the border may be given another width.
void start_as_trained(SearchChoices& options, const TrainedTask& task) {
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

SearchChoices with_trained(SearchChoices given, const TrainedTask& task) {
  if (!given.source && task.source) given.source = search::name_of(*task.source);
  if (!given.start && !given.start_margin_m) start_as_trained(given, task);
  if (!given.border_width_m && task.border_width) given.border_width_m = task.border_width->value;
  if (!given.max_steps) given.max_steps = task.max_steps;
  if (!given.vehicle_depth_m && task.vehicle_depth) given.vehicle_depth_m = task.vehicle_depth->value;
  return given;
}

bool apply(const SearchChoices& choices, search::SearchSettings& settings) {
  if (choices.source) settings.placement = search::placement_named(*choices.source).value_or(settings.placement);
  if (choices.border_width_m) settings.border_width = Meters{*choices.border_width_m};
  if (choices.max_steps) settings.max_steps = *choices.max_steps;
  if (choices.start) settings.start_region = search::start_region_of(settings, search::start_placement_named(*choices.start).value());
  if (choices.start_margin_m) settings.start_region = settings.domain.moved_in(Meters{*choices.start_margin_m});
  return search::check(settings) == Status::kOk;
}

}  // namespace earshot::description
