#include "policy/evaluate/task.hpp"

#include <sstream>
#include <utility>

#include "firmware/host/file/bad_input.hpp"

namespace earshot::evaluate {
namespace {

using description::TrainedTask;
using search::SearchSettings;
using search::SourcePlacement;

std::string in_metres(Meters length) {
  std::ostringstream text;
  text.precision(9);
  text << length.value << " m";
  return text.str();
}

std::string in_text(double number) {
  std::ostringstream text;
  text << number;
  return text.str();
}

std::string starts_from(Meters margin) {
  return margin.value == 0.0 ? "anywhere in the domain" : in_metres(margin) + " or more from every edge";
}

/// Collects what differs, a sentence each.
class Differences {
 public:
  /// @param made  "was trained"
  Differences(std::string name, std::string made) : name_(std::move(name)), made_(std::move(made)) {}
  void add(const std::string& trained, const std::string& tested) {
    sentences_.push_back(name_ + " " + made_ + " " + trained + " and is tested " + tested);
  }
  void add_sentence(const std::string& what) { sentences_.push_back(name_ + " " + what); }
  [[nodiscard]] std::vector<std::string> take() { return std::move(sentences_); }

 private:
  std::string name_;
  std::string made_;
  std::vector<std::string> sentences_;
};

void compare_sources(const TrainedTask& trained, const TestedTask& tested, Differences& all) {
  const SourcePlacement searched = tested.settings.placement;
  const std::string kind(search::name_of(searched));
  if (!trained.source) return all.add_sentence("does not state which source it was trained with and is tested with a " + kind + " one");
  if (*trained.source != searched) {
    return all.add("with a " + std::string(search::name_of(*trained.source)) + " source",
                   "with a " + kind + " one: another search than it is made for");
  }
  if (searched == SourcePlacement::kChanging) return;
  const auto place = [](NorthEast p) { return in_metres(p.north) + " north, " + in_metres(p.east) + " east"; };
  const NorthEast source = tested.settings.source;
  if (trained.source_position && *trained.source_position != source) {
    all.add("with the source at " + place(*trained.source_position),
            "with it at " + place(source) + ": another search than it is made for");
  } else if (!trained.source_position && trained.environment_crc32 != tested.environment_crc32) {
    all.add(
        "with the source where " + (trained.environment.empty() ? "an environment that it does not name" : trained.environment) + " had it",
        "with it at " + place(source) + ", where another environment puts it");
  }
}

void compare_starts(const TrainedTask& trained, const SearchSettings& settings, Differences& all) {
  const Meters tested = settings.start_region.south_west.north - settings.domain.south_west.north;
  std::optional<Meters> margin = trained.start_margin;
  if (!margin && trained.start == search::StartPlacement::kDomain) margin = Meters{0.0};
  if (!margin && trained.start == search::StartPlacement::kInsideBorder) margin = trained.border_width.value_or(settings.border_width);
  if (margin && *margin != tested) all.add("from starts " + starts_from(*margin), "from starts " + starts_from(tested));
}

void compare_rest(const TrainedTask& trained, const TestedTask& tested, Differences& all) {
  const SearchSettings& s = tested.settings;
  if (trained.border_width && *trained.border_width != s.border_width)
    all.add("with a border of " + in_metres(*trained.border_width), "with one of " + in_metres(s.border_width));
  if (trained.border_reward && *trained.border_reward != s.border_reward)
    all.add("with a reward of " + in_text(*trained.border_reward) + " at the edge", "with " + in_text(s.border_reward));
  if (trained.max_steps && *trained.max_steps != s.max_steps)
    all.add("to search for " + std::to_string(*trained.max_steps) + " steps", "over " + std::to_string(s.max_steps));
  if (trained.vehicle_depth && *trained.vehicle_depth != tested.vehicle_depth)
    all.add(in_metres(*trained.vehicle_depth) + " deep", in_metres(tested.vehicle_depth) + " deep");
}

}  // namespace

const Candidate* leading(std::span<const Candidate> candidates) {
  const Candidate* first = nullptr;
  for (const Candidate& c : candidates) {
    if (!c.learned) continue;
    if (trained_task(c).source) return &c;
    if (first == nullptr) first = &c;
  }
  return first;
}

TrainedTask trained_task(const Candidate& candidate) {
  if (!candidate.learned) return {};
  return description::trained_task({candidate.learned->provenance.begin(), candidate.learned->provenance.end()});
}

void check_same_source(std::span<const Candidate> candidates) {
  const Candidate* const first = leading(candidates);
  if (first == nullptr || !trained_task(*first).source) return;
  const SourcePlacement source = *trained_task(*first).source;
  for (const Candidate& c : candidates) {
    const std::optional<SourcePlacement> other = trained_task(c).source;
    if (!other || *other == source) continue;
    throw host::BadInput(first->name + " was trained with a " + std::string(search::name_of(source)) + " source, " + c.name + " with a " +
                         std::string(search::name_of(*other)) + " one: choose with --source which to search for");
  }
}

std::vector<std::string> differences(const Candidate& candidate, const TestedTask& tested) {
  if (!candidate.learned) return {};
  const TrainedTask trained = trained_task(candidate);
  const bool is_trained = policy::has_network(candidate.learned->network);
  Differences all(candidate.name, is_trained ? "was trained" : "is made for searches");
  compare_sources(trained, tested, all);
  // A belief's own advice holds for whatever search its tables are of, at their depth: nobody has trained it.
  if (!is_trained) return all.take();
  compare_starts(trained, tested.settings, all);
  compare_rest(trained, tested, all);
  return all.take();
}

Task task_of(const description::SearchChoices& given, std::span<const Candidate> candidates, const Candidate* leading) {
  const TrainedTask trained = leading == nullptr ? TrainedTask{} : trained_task(*leading);
  Task task{.choices = description::with_trained(given, trained),
            .settings = settings_of(candidates),
            .depth = {},
            .trained_by = trained.source ? leading->name : "",
            .as_trained = ""};
  if (trained.source)
    task.as_trained = " (as " + leading->name + (policy::has_network(leading->learned->network) ? " was trained)" : " is made for)");
  task.depth = Meters{task.choices.vehicle_depth_m.value_or(300.0)};
  task.settings.placement = SourcePlacement::kChanging;  // where neither a choice nor a training says it
  if (trained.border_reward) task.settings.border_reward = *trained.border_reward;
  return task;
}

NorthEast source_of(const Candidate* leading, const ocean::Environment& environment, bool is_given) {
  if (is_given || leading == nullptr) return environment.source.position;
  return trained_task(*leading).source_position.value_or(environment.source.position);
}

}  // namespace earshot::evaluate
