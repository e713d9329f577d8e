#include <algorithm>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "firmware/host/file/shipped.hpp"
#include "firmware/host/listening/listening_words.hpp"
#include "firmware/host/policy/unverified_policy.hpp"
#include "firmware/host/program/progress_bar.hpp"
#include "firmware/host/program/talk.hpp"
#include "firmware/host/toml/table_reader.hpp"
#include "policy/apps/world_options.hpp"
#include "policy/baselines/catalogue.hpp"
#include "policy/baselines/learned.hpp"
#include "policy/command_line/outputs.hpp"
#include "policy/command_line/policy_details.hpp"
#include "policy/command_line/run.hpp"
#include "policy/description/draw.hpp"
#include "policy/description/placement.hpp"
#include "policy/evaluate/evaluation.hpp"
#include "policy/evaluate/path_table.hpp"
#include "policy/evaluate/table.hpp"
#include "policy/evaluate/world_file.hpp"
#include "sim/parallel/rank_session.hpp"
#include "sim/plot/gnuplot.hpp"
#include "sim/search/soundscape.hpp"

namespace {

using namespace earshot;
using host::BadInput;

struct Options {
  std::vector<std::string> files;
  std::vector<std::string> policies;
  std::vector<std::string> worlds;
  bool suite = false;
  apps::WorldOptions search{.start = "inside_border"};
  std::size_t episodes = 300;
  std::optional<std::uint64_t> seed;
  std::optional<std::string> draw;
  std::optional<std::string> json;
  std::optional<std::string> csv;
  std::optional<std::string> plot;
  std::optional<std::string> paths;
  bool timing = false;
  bool force = false;
};

std::string names_of_baselines() {
  constexpr std::size_t kColumn = 20;
  std::string names;
  for (const baselines::Entry& entry : baselines::catalogue())
    names += "\n  " + std::string(entry.name) + std::string(kColumn - entry.name.size(), ' ') + std::string(entry.what);
  return names;
}

void add_options(program::CommandLine& line, Options& o) {
  line.option("POLICY", &o.files, "frozen policies (.policy)");
  line.option("--policies", &o.policies, "more of them, and others by name, separated by commas").separated_by(',');
  line.option("--world", &o.worlds, "world files to search in, such as policy/worlds/noisy_4db.toml (the environment itself)");
  line.flag("--suite", &o.suite, "search in every world of policy/worlds");
  o.search.add_to(line, {.source = "what the policies were trained with, changing when none says it",
                         .listening = "what the .policy files have, newest when none is evaluated"});
  line.option("--episodes", &o.episodes, "searches to fly in each world").shows_default().from(1, 100'000'000);
  line.option("--seed", &o.seed, "seed of starts, sources and sampled actions (a world's own; 1 without a world)");
  line.option("--draw", &o.draw, "how learned policies draw actions, instead of each one's own way")
      .one_of({description::kDraws.begin(), description::kDraws.end()});
  line.option("--json", &o.json, "also write the figures there");
  line.option("--csv", &o.csv, "also write the table there");
  line.option("--plot", &o.plot, "also draw it there (.png or .svg)");
  line.option("--paths", &o.paths, "also write there where every search went, step by step (CSV)");
  line.flag("--timing", &o.timing, "write the time per decision into the files too, whose bytes then differ from run to run");
  line.flag("--force", &o.force, command_line::kForceHelp);
  line.footer(
      "By name:\n  shipped             the policy that ships (policy/frozen)" + names_of_baselines() +
      "\nAll fly the same starts in the same worlds. In a world all but the oracles go by what the --environment says is heard, learned "
      "policies by what their file says.\n"
      "mpirun -n N earshot evaluate ... shares the searches out.\n"
      "Example: earshot evaluate --policies shipped,bayes,oracle --episodes 3000 --json evaluation.json");
}

/// One that searches: a learned policy, or a baseline when there is none.
struct Contestant {
  std::string name;
  std::unique_ptr<policy::FrozenPolicy> learned;
};

Contestant contestant_named(const std::string& name) {
  for (const baselines::Entry& entry : baselines::catalogue()) {
    if (entry.name == name) return {name, nullptr};
  }
  if (name == "shipped") return {name, host::load_unverified_policy(host::shipped("policy/frozen/shipped.policy"))};
  if (name.find_first_of("./") == std::string::npos) {
    std::string known = "shipped";
    for (const baselines::Entry& entry : baselines::catalogue()) known += ", " + std::string(entry.name);
    throw BadInput("--policies: " + name + ": neither a .policy file nor one of " + known);
  }
  return {name, host::load_unverified_policy(name)};
}

/// For --verbose.
void print_details(const Contestant& contestant) {
  if (contestant.learned)
    command_line::print_policy_details(contestant.name, *contestant.learned);
  else
    program::detail() << contestant.name << ": goes by what is expected to be heard\n";
}

std::vector<Contestant> contestants_of(const Options& o) {
  std::vector<Contestant> contestants;
  for (const auto* names : {&o.files, &o.policies}) {
    for (const std::string& name : *names) contestants.push_back(contestant_named(name));
  }
  if (contestants.empty()) throw BadInput("earshot evaluate: no policy given; try --policies shipped,bayes,oracle");
  return contestants;
}

/// The search that the learned policies were trained for, the paper's when there is none. Policies that listen otherwise than each other
/// can be compared only over a window that is given to all.
search::SearchSettings settings_of(const std::vector<Contestant>& contestants, const apps::ListeningOptions& listening) {
  const Contestant* first = nullptr;
  for (const Contestant& c : contestants) {
    if (!c.learned) continue;
    if (first == nullptr) first = &c;
    const policy::FrozenPolicy& a = *first->learned;
    const policy::FrozenPolicy& b = *c.learned;
    if (a.step_length != b.step_length || a.area_size != b.area_size || a.detection_threshold != b.detection_threshold)
      throw BadInput(c.name + ": was trained for another area, step length or detection threshold than " + first->name +
                     ": evaluate them one by one");
    if (a.observation.listening != b.observation.listening && !listening.is_given())
      throw BadInput(c.name + ": listens over another window than " + first->name +
                     ": evaluate them one by one, or give both the same window (--listening)");
  }
  return first == nullptr ? search::SearchSettings{} : evaluate::search_of(*first->learned);
}

std::optional<search::SourcePlacement> trained_with(const Contestant& c) {
  if (!c.learned) return std::nullopt;
  return description::placement_in({c.learned->provenance.begin(), c.learned->provenance.end()});
}

/// The source that the learned policies were trained with. Throws where they were trained with both kinds: whichever were searched for, the
/// rows of some would be of a task they never learned.
search::SourcePlacement placement_of(const std::vector<Contestant>& contestants) {
  const Contestant* first = nullptr;
  for (const Contestant& c : contestants) {
    if (!trained_with(c)) continue;
    if (first == nullptr) first = &c;
    if (trained_with(c) != trained_with(*first)) {
      throw BadInput(first->name + " was trained with a " + std::string(description::name_of(*trained_with(*first))) + " source, " +
                     c.name + " with a " + std::string(description::name_of(*trained_with(c))) +
                     " one: say which to search for with --source");
    }
  }
  return first == nullptr ? search::SourcePlacement::kChanging : *trained_with(*first);
}

/// Policies that are about to be tested on another task than they were trained for.
void warn_of_another_source(const std::vector<Contestant>& contestants, search::SourcePlacement searched) {
  for (const Contestant& c : contestants) {
    const std::optional<search::SourcePlacement> trained = trained_with(c);
    if (!trained || *trained == searched) continue;
    std::cerr << "earshot evaluate: warning: " << c.name << " was trained with a " << description::name_of(*trained)
              << " source and is tested with a " << description::name_of(searched) << " one: it never learned what is asked of it\n";
  }
}

std::vector<evaluate::World> worlds_of(const Options& o, const std::filesystem::path& environment, Meters depth) {
  std::vector<std::filesystem::path> files(o.worlds.begin(), o.worlds.end());
  if (o.suite) {
    for (const std::filesystem::path& path : evaluate::worlds_in(host::shipped("policy/worlds"))) files.push_back(path);
  }
  std::vector<evaluate::World> worlds;
  for (const std::filesystem::path& file : files) worlds.push_back(evaluate::load_world(file));
  if (worlds.empty()) {
    ocean::Environment own = apps::environment_at(environment, depth);
    worlds.push_back({.name = environment.stem().string(), .what = own.name, .seed = 1, .environment = std::move(own)});
  }
  for (evaluate::World& world : worlds) world.seed = o.seed.value_or(world.seed);
  return worlds;
}

/// Everything a contest needs but a contestant.
struct Arena {
  const evaluate::World& world;
  const search::Soundscape& soundscape;
  const sonar::SnrCurve& expected;
  search::SearchSettings settings;
  std::size_t episodes;
  std::optional<policy::ActionDraw> draw;
};

std::vector<evaluate::Flight> fly_share(const Contestant& contestant, const Arena& arena, const parallel::Ranks& ranks,
                                        evaluate::PathTable* paths) {
  std::optional<program::ProgressBar> bar;
  if (ranks.rank() == 0) bar.emplace(arena.world.name + ", " + contestant.name);
  search::SearchSettings settings = arena.settings;
  if (contestant.learned) settings.direction_count = contestant.learned->actions.size();
  search::SearchWorld world(settings, arena.soundscape, arena.world.environment.conditions);
  if (contestant.learned) world.actions = contestant.learned->actions;
  const baselines::PriorKnowledge prior{.settings = settings, .actions = world.actions, .snr = arena.expected};
  std::unique_ptr<baselines::Searcher> searcher;
  if (contestant.learned) {
    searcher = std::make_unique<baselines::Learned>(*contestant.learned, arena.draw.value_or(contestant.learned->draw), settings.domain);
  } else {
    searcher = baselines::make_baseline(contestant.name, prior);
  }
  const evaluate::Watcher watcher = [&](std::size_t number, const search::Episode& episode) {
    if (bar) bar->update(static_cast<double>(number) / static_cast<double>(arena.episodes));
    if (paths != nullptr) paths->add(arena.world.name, contestant.name, number, episode);
  };
  return evaluate::fly(*searcher, world, {.end = arena.episodes, .first = ranks.rank(), .stride = ranks.size()}, arena.world.seed, watcher);
}

/// On rank 0: the searches of all ranks in the order of one alone; elsewhere nothing.
std::vector<evaluate::Flight> gathered(const std::vector<evaluate::Flight>& mine, std::size_t episodes, parallel::Ranks& ranks) {
  const auto shares = parallel::gather_values(ranks, std::span(mine));
  std::vector<evaluate::Flight> all(shares.empty() ? 0 : episodes);
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = shares[i % shares.size()][i / shares.size()];
  return all;
}

nlohmann::ordered_json as_json(const evaluate::Row& row, evaluate::Timing timing) {
  const evaluate::Summary& s = row.summary;
  const auto interval = [](const evaluate::Interval& i) { return nlohmann::ordered_json{i.low, i.high}; };
  nlohmann::ordered_json json{{"world", row.world},
                              {"policy", row.policy},
                              {"episodes", s.episodes},
                              {"mean_reward", s.mean_reward},
                              {"mean_reward_95", interval(row.intervals.mean_reward)},
                              {"lower_quartile_reward", s.lower_quartile_reward},
                              {"median_reward", s.median_reward},
                              {"median_reward_95", interval(row.intervals.median_reward)},
                              {"upper_quartile_reward", s.upper_quartile_reward},
                              {"found_fraction", s.found_fraction},
                              {"found_fraction_95", interval(row.intervals.found_fraction)},
                              {"left_domain_fraction", s.left_domain_fraction},
                              {"path_over_straight", row.path_over_straight},
                              {"path_over_straight_95", interval(row.intervals.path_over_straight)},
                              {"mean_steps", s.mean_steps},
                              {"mean_detections", s.mean_detections}};
  if (timing == evaluate::Timing::kIncluded) json["decision_us"] = 1e6 * row.decision_s;
  return json;
}

std::string as_json(const Options& o, const search::SearchSettings& settings, const std::vector<evaluate::World>& worlds,
                    const std::vector<evaluate::Row>& rows, evaluate::Timing timing) {
  nlohmann::ordered_json json{{"episodes", o.episodes}, {"source", description::name_of(settings.placement)}};
  if (o.search.start_margin_m)
    json["start_margin_m"] = *o.search.start_margin_m;
  else
    json["start"] = *o.search.start;
  json["border_width_m"] = settings.border_width.value;
  json["max_steps"] = settings.max_steps;
  json["listening"] = host::word_for(settings.listening.listening);
  json["listening_window_s"] = host::length_s(settings.listening);
  for (const evaluate::World& world : worlds) json["worlds"].push_back({{"name", world.name}, {"what", world.what}, {"seed", world.seed}});
  for (const evaluate::Row& row : rows) json["results"].push_back(as_json(row, timing));
  return json.dump(1) + "\n";
}

/// "300 searches each in munk_flat, source changing"
std::string title_of(const Options& o, const search::SearchSettings& settings, const std::vector<evaluate::World>& worlds) {
  return std::to_string(o.episodes) + " searches each in " +
         (worlds.size() == 1 ? worlds.front().name : std::to_string(worlds.size()) + " worlds") + ", source " +
         std::string(description::name_of(settings.placement));
}

void write_files(const Options& o, const search::SearchSettings& settings, const std::vector<evaluate::World>& worlds,
                 const std::vector<evaluate::Row>& rows) {
  const evaluate::Timing timing = o.timing ? evaluate::Timing::kIncluded : evaluate::Timing::kLeftOut;
  if (o.json) host::write_whole(*o.json, as_json(o, settings, worlds, rows, timing));
  if (o.csv) host::write_whole(*o.csv, evaluate::as_csv(rows, timing));
  if (!o.plot) return;
  try {
    const std::string title = title_of(o, settings, worlds);
    plot::draw(*o.plot, {.title = title, .size = "1400,900", .commands = evaluate::as_plot(rows, title)});
  } catch (const std::runtime_error& e) {
    throw BadInput(e.what());
  }
}

constexpr host::OutputKind kFiguresOutput{"figures of earshot evaluate (JSON)", {"{\n \"episodes\"", {}}};
constexpr host::OutputKind kTableOutput{"a table of earshot evaluate (CSV)", {"world,policy,episodes,", {}}};
constexpr host::OutputKind kPathsOutput{"paths of earshot evaluate (CSV)", {"world,policy,episode,step,", {}}};

void check_files(const Options& o) {
  if (o.plot) command_line::check_picture_name("--plot", *o.plot);
  std::vector<command_line::Output> files;
  if (o.json) files.push_back({"--json", *o.json, kFiguresOutput});
  if (o.csv) files.push_back({"--csv", *o.csv, kTableOutput});
  if (o.plot) files.push_back({"--plot", *o.plot, host::picture_kind(*o.plot)});
  if (o.paths) files.push_back({"--paths", *o.paths, kPathsOutput});
  command_line::require_writable(files, host::replaced_by(o.force));
}

/// "source fixed at 10000 m north, 10000 m east (as fixed.policy was trained); starts inside_border"
std::string what_is_searched(const Options& o, const search::SearchSettings& settings, const std::vector<Contestant>& contestants) {
  std::ostringstream text;
  text << "source " << description::name_of(settings.placement);
  if (settings.placement == search::SourcePlacement::kFixed)
    text << " at " << settings.source.north.value << " m north, " << settings.source.east.value << " m east";
  const auto trained = std::ranges::find_if(contestants, [](const Contestant& c) { return trained_with(c).has_value(); });
  if (!o.search.source && trained != contestants.end()) text << " (as " << trained->name << " was trained)";
  if (settings.listening != config::ListeningWindow{}) text << "; hears the " << host::to_string(settings.listening);
  text << "; starts ";
  if (o.search.start_margin_m)
    text << *o.search.start_margin_m << " m or more from every edge\n";
  else
    text << *o.search.start << "\n";
  return text.str();
}

void evaluate_policies(const Options& o, parallel::RankSession& session) {
  parallel::Ranks& ranks = session.ranks();
  const bool speaks = ranks.rank() == 0;
  if (o.paths && ranks.size() > 1) throw BadInput("--paths: not with several MPI ranks");
  const std::vector<Contestant> contestants = contestants_of(o);
  const Meters depth{o.search.vehicle_depth_m.value_or(300.0)};
  const std::filesystem::path environment_file =
      o.search.environment ? std::filesystem::path(*o.search.environment) : host::shipped("sim/ocean/environments/munk_flat.toml");
  const ocean::Environment environment = apps::environment_at(environment_file, depth);
  const std::vector<evaluate::World> worlds = worlds_of(o, environment_file, depth);
  std::optional<search::SourcePlacement> placement;
  if (!o.search.source) placement = placement_of(contestants);
  search::SearchSettings settings = settings_of(contestants, o.search.listening);
  settings.source = environment.source.position;
  if (placement) settings.placement = *placement;
  o.search.apply_to(settings);
  session.all_or_none<BadInput>([&] {
    if (speaks) check_files(o);
  });
  warn_of_another_source(contestants, settings.placement);
  if (speaks) {
    for (const Contestant& c : contestants) print_details(c);
    program::detail() << environment_file.string() << ": " << environment.name << "; the vehicle " << depth.value << " m deep\n"
                      << ranks.size() << (ranks.size() == 1 ? " process\n" : " processes\n");
    program::say() << what_is_searched(o, settings, contestants);
  }
  const sonar::SnrCurve expected = apps::curve_for(environment, depth, settings);
  std::optional<policy::ActionDraw> draw;
  if (o.draw) draw = description::draw_named(*o.draw);

  std::vector<evaluate::Row> rows;
  evaluate::PathTable paths;
  for (const evaluate::World& world : worlds) {
    const search::Soundscape soundscape = apps::soundscape_for(world.environment, depth, settings);
    const Arena arena{world, soundscape, expected, settings, o.episodes, draw};
    const std::size_t first_row = rows.size();
    for (const Contestant& contestant : contestants) {
      const std::vector<evaluate::Flight> flights =
          gathered(fly_share(contestant, arena, ranks, o.paths ? &paths : nullptr), o.episodes, ranks);
      if (speaks) rows.push_back(evaluate::row_of(world.name, contestant.name, flights, world.seed));
    }
    if (speaks) {
      program::say() << world.name << ": " << world.what << "; " << o.episodes << " searches, seed " << world.seed << "\n"
                     << evaluate::as_text(std::span(rows).subspan(first_row)) << std::endl;
    }
  }
  if (speaks) write_files(o, settings, worlds, rows);
  if (o.paths) host::write_whole(*o.paths, paths.csv());
}

}  // namespace

int main(int argc, char** argv) {
  program::CommandLine line("earshot evaluate", "Flies many simulated searches with policies and baselines and says how they did.");
  Options options;
  add_options(line, options);
  return command_line::run_ranked(line, argc, argv, [&](parallel::RankSession& session) { evaluate_policies(options, session); });
}
