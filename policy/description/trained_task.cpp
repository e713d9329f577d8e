#include "policy/description/trained_task.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <limits>

#include "firmware/host/text/numbers.hpp"

namespace earshot::description {
namespace {

/// The value of the first line of a name.
std::optional<std::string_view> value_of(std::string_view provenance, std::string_view name) {
  constexpr std::string_view kIs = " = ";
  while (!provenance.empty()) {
    const std::string_view line = provenance.substr(0, provenance.find('\n'));
    if (line.starts_with(name) && line.substr(name.size()).starts_with(kIs)) return line.substr(name.size() + kIs.size());
    provenance.remove_prefix(std::min(provenance.size(), line.size() + 1));
  }
  return std::nullopt;
}

template <class Number>
std::optional<Number> number_in(std::string_view text) {
  Number number{};
  const auto read = std::from_chars(text.data(), text.data() + text.size(), number);
  if (read.ec != std::errc() || read.ptr != text.data() + text.size()) return std::nullopt;
  return number;
}

/// A number from `lowest` on; NaN and infinity are none.
std::optional<double> number_of(std::string_view provenance, std::string_view name, double lowest) {
  const std::optional<std::string_view> text = value_of(provenance, name);
  const std::optional<double> number = text ? number_in<double>(*text) : std::nullopt;
  return number && std::isfinite(*number) && *number >= lowest ? number : std::nullopt;
}

std::optional<Meters> length_named(std::string_view provenance, std::string_view name) {
  const std::optional<double> length_m = number_of(provenance, name, 0.0);
  return length_m ? std::optional(Meters{*length_m}) : std::nullopt;
}

std::optional<Meters> above_zero(std::optional<Meters> length) {
  return length && length->value > 0.0 ? length : std::nullopt;
}

std::optional<NorthEast> place_of(std::string_view provenance) {
  constexpr double kAnywhere = std::numeric_limits<double>::lowest();
  const std::optional<double> north_m = number_of(provenance, "source_north_m", kAnywhere);
  const std::optional<double> east_m = number_of(provenance, "source_east_m", kAnywhere);
  if (!north_m || !east_m) return std::nullopt;
  return NorthEast{Meters{*north_m}, Meters{*east_m}};
}

std::optional<std::uint32_t> steps_of(std::string_view provenance) {
  const std::optional<std::string_view> text = value_of(provenance, "max_steps");
  const std::optional<std::uint32_t> steps = text ? number_in<std::uint32_t>(*text) : std::nullopt;
  return steps && *steps >= 1 ? steps : std::nullopt;
}

}  // namespace

TrainedTask trained_task(std::string_view provenance) {
  TrainedTask task;
  if (const auto name = value_of(provenance, "source")) task.source = search::placement_named(*name);
  if (const auto name = value_of(provenance, "start")) task.start = search::start_placement_named(*name);
  task.source_position = place_of(provenance);
  task.start_margin = length_named(provenance, "start_margin_m");
  task.border_width = above_zero(length_named(provenance, "border_width_m"));
  task.border_reward = number_of(provenance, "border_reward", std::numeric_limits<double>::lowest());
  task.max_steps = steps_of(provenance);
  task.vehicle_depth = above_zero(length_named(provenance, "vehicle_depth_m"));
  task.environment = value_of(provenance, "environment").value_or("");
  task.environment_crc32 = value_of(provenance, "environment_crc32").value_or("");
  return task;
}

Lines source_place_lines(const search::SearchSettings& settings) {
  if (settings.placement == search::SourcePlacement::kChanging) return {};
  return {{"source_north_m", host::shortest(settings.source.north.value)}, {"source_east_m", host::shortest(settings.source.east.value)}};
}

Lines task_lines(const search::SearchSettings& settings, Meters vehicle_depth) {
  Lines lines{{"vehicle_depth_m", host::shortest(vehicle_depth.value)}, {"source", std::string(search::name_of(settings.placement))}};
  for (auto& line : source_place_lines(settings)) lines.push_back(std::move(line));
  lines.emplace_back("start_margin_m", host::shortest((settings.start_region.south_west.north - settings.domain.south_west.north).value));
  lines.emplace_back("border_width_m", host::shortest(settings.border_width.value));
  lines.emplace_back("border_reward", host::shortest(settings.border_reward));
  lines.emplace_back("max_steps", std::to_string(settings.max_steps));
  return lines;
}

}  // namespace earshot::description
