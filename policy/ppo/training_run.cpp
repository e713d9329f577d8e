#include "policy/ppo/training_run.hpp"

#include <algorithm>
#include <cassert>
#include <charconv>
#include <limits>
#include <optional>
#include <sstream>

#include "firmware/config/capacities.hpp"
#include "firmware/host/listening/listening_words.hpp"
#include "firmware/host/text/numbers.hpp"
#include "firmware/host/toml/table_reader.hpp"
#include "sim/search/scenario/placement.hpp"

namespace earshot::ppo {
namespace {

using host::Range;
using host::TableReader;

// What a rollout and a batch of it take: under 2 GiB each with the longest observation. The shipped run has 32 768 steps and 2048.
constexpr std::int64_t kMostRolloutSteps = 1 << 22;
constexpr std::int64_t kMostBatch = 1 << 18;

constexpr double kFurthest_m = 1e6;  // of a plane
constexpr double kDeepest_m = 12'000.0;
const Range kLength_m = Range::above_up_to(0.0, kFurthest_m);
constexpr double kUnclipped = 1e30;  // a greater norm than any that floats can have
const Range kReward = Range::between(-1e6, 1e6);

constexpr std::int64_t kMany = std::numeric_limits<std::int64_t>::max();

std::size_t read_size(TableReader& table, std::string_view key, std::size_t fallback, std::int64_t lowest, std::int64_t highest) {
  return static_cast<std::size_t>(table.integer_or(key, static_cast<std::int64_t>(fallback), lowest, highest));
}

Start read_search(TableReader table, search::SearchSettings& s) {
  const double width = table.number_or("domain_east_m", 25'000.0, kLength_m);
  const double height = table.number_or("domain_north_m", 25'000.0, kLength_m);
  s.domain = {{Meters{0.0}, Meters{0.0}}, {Meters{height}, Meters{width}}};
  s.placement =
      static_cast<search::SourcePlacement>(table.choice_or("source", 0, {search::kPlacements.begin(), search::kPlacements.end()}));
  s.direction_count = read_size(table, "directions", s.direction_count, 1, config::kMaxActions);
  s.step_length = Meters{table.number_or("step_length_m", s.step_length.value, kLength_m)};
  s.max_steps = static_cast<std::uint32_t>(read_size(table, "max_steps", s.max_steps, 1, 1'000'000));
  s.detection_threshold = Decibels{table.number_or("detection_threshold_db", s.detection_threshold.value, Range::between(-200.0, 200.0))};
  s.border_width = Meters{table.number_or("border_width_m", s.border_width.value, kLength_m)};
  s.border_reward = table.number_or("border_reward", s.border_reward, kReward);
  s.listening = host::read_listening(table);
  const auto start =
      static_cast<search::StartPlacement>(table.choice_or("start", 0, {search::kStartPlacements.begin(), search::kStartPlacements.end()}));
  s.start_region = search::start_region_of(s, start);
  if (!table.has("start_margin_m")) return start == search::StartPlacement::kDomain ? Start::kRegion : Start::kInsideBorder;
  if (table.has("start")) table.problem("start_margin_m", "takes the place of start: give one of the two");
  s.start_region = s.domain.moved_in(Meters{table.number("start_margin_m", Range::at_least(0.0))});
  return Start::kRegion;
}

void read_hyper_parameters(TableReader table, HyperParameters& h) {
  h.environment_count = read_size(table, "environments", h.environment_count, 1, kMostEnvironments);
  h.steps_per_rollout = read_size(table, "steps_per_rollout", h.steps_per_rollout, 2, kMostRolloutSteps);
  h.batch_size = read_size(table, "batch_size", h.batch_size, 2, kMostBatch);
  h.epochs = read_size(table, "epochs", h.epochs, 1, 10'000);
  h.learning_rate = table.number_or("learning_rate", h.learning_rate, Range::above_up_to(0.0, 1.0));
  h.discount = table.number_or("discount", h.discount, Range::between(0.0, 1.0));
  h.gae_lambda = table.number_or("gae_lambda", h.gae_lambda, Range::between(0.0, 1.0));
  h.clip_range = table.number_or("clip_range", h.clip_range, Range::above_up_to(0.0, 10.0));
  h.value_coefficient = table.number_or("value_coefficient", h.value_coefficient, Range::between(0.0, 1e6));
  h.entropy_coefficient = table.number_or("entropy_coefficient", h.entropy_coefficient, Range::between(0.0, 1000.0));
  h.max_gradient_norm = table.number_or("max_gradient_norm", h.max_gradient_norm, Range::above_up_to(0.0, kUnclipped));
  h.target_kl = table.number_or("target_kl", h.target_kl, Range::between(0.0, 1000.0));
  h.reward.scale = table.number_or("reward_scale", h.reward.scale, Range::above_up_to(0.0, 1e6));
}

template <class Value>
std::string in_text(const Value& value) {
  std::ostringstream text;
  text << value;
  return text.str();
}

/// Six digits, as long as they say it exactly; otherwise as many more as it takes.
std::string in_text(double value) {
  std::string text;
  for (int precision = 6; precision <= std::numeric_limits<double>::max_digits10; ++precision) {
    text = host::significant(value, precision);
    double read = 0.0;
    if (std::from_chars(text.data(), text.data() + text.size(), read).ec == std::errc() && read == value) break;
  }
  return text;
}

}  // namespace

Mismatch mismatch_of(const HyperParameters& h) {
  const std::size_t steps = h.environment_count * h.steps_per_rollout;
  const std::string rollout = "environments x steps_per_rollout = " + std::to_string(steps);
  if (steps > static_cast<std::size_t>(kMostRolloutSteps))
    return {"steps_per_rollout", rollout + ": a rollout must not exceed " + std::to_string(kMostRolloutSteps) + " steps"};
  if (h.batch_size > steps) return {"batch_size", "must not exceed a rollout, " + rollout};
  return {};
}

TrainingRun load_run(const std::filesystem::path& path) {
  const host::TomlFile file(path);
  TableReader root = file.root();
  TrainingRun run;
  if (root.has("environment")) run.environment = file.resolve(root.text("environment"));
  if (root.has("worlds")) {
    for (const std::string& world : root.texts("worlds")) run.worlds.push_back(file.resolve(world));
  }
  if (root.has("tables")) {
    for (const std::string& tables : root.texts("tables")) run.tables.push_back(file.resolve(tables));
  }
  run.vehicle_depth = Meters{root.number_or("vehicle_depth_m", run.vehicle_depth.value, Range::above_up_to(0.0, kDeepest_m))};
  run.state = static_cast<description::State>(root.choice_or("state", 0, {description::kStates.begin(), description::kStates.end()}));
  run.remembered_steps = read_size(root, "remembered_steps", run.remembered_steps, 1, config::kMaxRememberedSteps);
  run.seed = static_cast<std::uint64_t>(root.integer_or("seed", 1, 0, kMany));
  run.episodes = static_cast<std::uint64_t>(root.integer_or("episodes", 0, 0, kMany));
  run.steps = static_cast<std::uint64_t>(root.integer_or("steps", 0, 0, kMany));
  std::optional<TableReader> search = root.optional_table("search");
  if (search) run.start = read_search(*search, run.search);
  if (auto table = root.optional_table("ppo")) {
    read_hyper_parameters(*table, run.hyper);
    const bool are_as_written = !table->is_noted("environments") && !table->is_noted("steps_per_rollout") && !table->is_noted("batch_size");
    if (const Mismatch mismatch = mismatch_of(run.hyper); are_as_written && mismatch.key != nullptr)
      table->problem(mismatch.key, mismatch.what);
    run.learning_rate_schedule = static_cast<LearningRateSchedule>(table->choice_or("learning_rate_schedule", 0, {"constant", "linear"}));
  }
  if (auto table = root.optional_table("training_reward")) read_training_reward(*table, run.hyper.reward);
  file.finish();
  if (search && search::check(run.search) != Status::kOk)
    search->problem("border_width_m", "must leave room inside the border for the start");
  file.finish();
  return run;
}

policy::ObservationModel observation_of(const TrainingRun& run) {
  return description::observation_of(run.state, run.remembered_steps, run.search);
}

std::vector<std::pair<std::string, std::string>> describe(const TrainingRun& run) {
  std::vector<std::pair<std::string, std::string>> lines;
  auto add = [&lines](std::string_view name, const auto& value) { lines.emplace_back(name, in_text(value)); };
  const search::SearchSettings& s = run.search;
  const HyperParameters& h = run.hyper;
  add("vehicle_depth_m", run.vehicle_depth.value);
  add("state", description::name_of(run.state));
  if (description::remembers(run.state)) add("remembered_steps", run.remembered_steps);
  add("source", search::name_of(s.placement));
  add("start_margin_m", (s.start_region.south_west.north - s.domain.south_west.north).value);
  add("border_width_m", s.border_width.value);
  add("border_reward", s.border_reward);
  add("max_steps", s.max_steps);
  add("detection_threshold_db", s.detection_threshold.value);
  if (s.listening != config::ListeningWindow{}) {
    add("listening", host::word_for(s.listening.listening));
    add("listening_window_s", host::length_s(s.listening));
  }
  add("seed", run.seed);
  add("environments", h.environment_count);
  add("steps_per_rollout", h.steps_per_rollout);
  add("batch_size", h.batch_size);
  add("epochs", h.epochs);
  add("learning_rate", h.learning_rate);
  add("learning_rate_schedule", run.learning_rate_schedule == LearningRateSchedule::kConstant ? "constant" : "linear");
  if (h.decay_steps > 0) add(kDecayStepsName, h.decay_steps);
  add("discount", h.discount);
  add("gae_lambda", h.gae_lambda);
  add("clip_range", h.clip_range);
  add("value_coefficient", h.value_coefficient);
  add("entropy_coefficient", h.entropy_coefficient);
  add("max_gradient_norm", h.max_gradient_norm);
  add("target_kl", h.target_kl);
  for (const auto& [name, value] : describe(h.reward)) add(name, value);
  return lines;
}

}  // namespace earshot::ppo
