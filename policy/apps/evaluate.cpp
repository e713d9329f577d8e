#include <algorithm>
#include <iostream>
#include <optional>
#include <span>
#include <sstream>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "firmware/host/file/checksum_text.hpp"
#include "firmware/host/file/distinct_files.hpp"
#include "firmware/host/file/printable.hpp"
#include "firmware/host/file/shipped.hpp"
#include "firmware/host/listening/listening_words.hpp"
#include "firmware/host/policy/tables_choice.hpp"
#include "firmware/host/program/progress_bar.hpp"
#include "firmware/host/program/talk.hpp"
#include "firmware/host/program/wrapped.hpp"
#include "firmware/host/text/numbers.hpp"
#include "firmware/host/toml/table_reader.hpp"
#include "policy/apps/evaluate_mission.hpp"
#include "policy/apps/evaluate_tables.hpp"
#include "policy/baselines/catalogue.hpp"
#include "policy/command_line/outputs.hpp"
#include "policy/command_line/policy_details.hpp"
#include "policy/command_line/run.hpp"
#include "policy/command_line/scenario_options.hpp"
#include "policy/description/draw.hpp"
#include "policy/evaluate/candidates.hpp"
#include "policy/evaluate/evaluation.hpp"
#include "policy/evaluate/output/figures_json.hpp"
#include "policy/evaluate/output/path_table.hpp"
#include "policy/evaluate/output/searches_json.hpp"
#include "policy/evaluate/output/table.hpp"
#include "policy/evaluate/output/table_plot.hpp"
#include "policy/evaluate/task.hpp"
#include "policy/evaluate/time_to_find.hpp"
#include "policy/evaluate/trial.hpp"
#include "policy/evaluate/world_file.hpp"
#include "policy/report/page/page_template.hpp"
#include "sim/parallel/rank_session.hpp"
#include "sim/plot/gnuplot.hpp"
#include "sim/search/known_ocean.hpp"
#include "sim/search/scenario/placement.hpp"
#include "sim/search/scenario/world.hpp"

namespace {

using namespace earshot;
using host::BadInput;

struct Options {
  std::vector<std::string> files;
  std::vector<std::string> policies;
  std::vector<std::string> worlds;
  std::optional<std::string> mission;
  bool suite = false;
  command_line::ScenarioOptions search;
  std::size_t episodes = 300;
  std::optional<std::uint64_t> seed;
  std::optional<std::string> draw;
  std::optional<std::string> json;
  std::optional<std::string> csv;
  std::optional<std::string> plot;
  std::optional<std::string> paths;
  std::optional<std::string> page;
  std::vector<std::string> tables;
  bool declared = false;
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
  line.option("--world", &o.worlds, "world files to search in, such as policy/worlds/noisy_4db.toml (the environment itself)")
      .names("a file");
  line.flag("--suite", &o.suite, "search in every world of policy/worlds, without --world");
  line.option("--mission", &o.mission,
              "mission file: its area, depth, speed, steps, limits, listening and tables; without a POLICY its policy, too")
      .names("a file");
  o.search.add_to(line,
                  {.source = "what the policies were trained with, changing when none states it",
                   .start = "what the policies were trained with, inside_border when none states it; --border-width-m, --max-steps and "
                            "--vehicle-depth-m likewise",
                   .listening = "what the .policy files have, newest when none is evaluated"});
  line.option(
          "--tables", &o.tables,
          "oceans that policies and ocean_search think possible (.tables, or folders of them); of several those for a world's depth and "
          "frequency; default: those that ship, or where these are of another depth or frequency the environment alone")
      .names("a file or a folder");
  line.option("--episodes", &o.episodes, "searches to fly in each world").shows_default().from(1, 100'000'000);
  line.option("--seed", &o.seed, "seed of starts, sources and sampled actions (a world's own; 1 without a world)");
  line.option("--draw", &o.draw, "how learned policies draw actions, instead of each one's own way")
      .one_of({description::kDraws.begin(), description::kDraws.end()});
  line.option("--json", &o.json, "also write the figures there");
  line.option("--csv", &o.csv, "also write the table there");
  line.option("--plot", &o.plot, "also draw it there (.png or .svg)");
  line.option("--paths", &o.paths, "also write there where every search went, step by step (CSV)");
  line.option("--page", &o.page,
              "also write a page there (HTML, needs no other file): every policy in every world, and the paths of the first 50 searches of "
              "each")
      .names("a file");
  line.flag("--declared", &o.declared,
            "as at sea, nobody reports to a searcher that the source is found: a search of one that declares it itself (ocean_search) ends "
            "when it does so within a step length of a source");
  line.flag("--timing", &o.timing, "write the time per decision into the files too, whose bytes then differ from run to run");
  line.flag("--force", &o.force, command_line::kForceHelp);
  line.footer(
      "By name:\n  shipped             the policy that ships (policy/frozen)" + names_of_baselines() +
      "\nAll fly the same starts in the same worlds. In a world all but the oracles go by what is heard by the --environment, learned "
      "policies by what their file states; the vehicle is as deep as the world states. Who was trained for another search than is flown is "
      "warned of.\n"
      "mpirun -n N earshot evaluate ... shares the searches out.\n"
      "Example: earshot evaluate --policies shipped,bayes,oracle --episodes 3000 --json evaluation.json");
}

/// Prints, with --verbose, what a candidate sees and does.
void print_details(const evaluate::Candidate& candidate) {
  if (candidate.learned)
    command_line::print_policy_details(candidate.name, *candidate.learned);
  else
    program::detail() << candidate.name << ": goes by what is expected to be heard\n";
}

std::vector<evaluate::Candidate> candidates_of(const Options& o, const std::optional<evaluate::FlownMission>& mission) {
  std::vector<evaluate::Candidate> candidates;
  for (const auto* names : {&o.files, &o.policies}) {
    for (const std::string& name : *names) candidates.push_back(evaluate::candidate_named(name));
  }
  if (candidates.empty() && mission) candidates.push_back(evaluate::policy_of(*mission));
  for (const std::string& repeated : evaluate::leave_out_repeated(candidates)) program::print() << host::printable(repeated) << "\n";
  if (candidates.empty()) throw BadInput("earshot evaluate: no policy given; try --policies shipped,bayes,oracle");
  return candidates;
}

/// What candidates are about to be tested in that they were not trained for.
std::vector<std::string> warnings_of(std::span<const evaluate::Candidate> candidates, const evaluate::TestedTask& tested) {
  std::vector<std::string> warnings;
  for (const evaluate::Candidate& c : candidates) {
    for (std::string& difference : evaluate::differences(c, tested)) warnings.push_back(std::move(difference));
  }
  return warnings;
}

std::vector<evaluate::WorldFile> worlds_of(const Options& o, const std::filesystem::path& environment, const search::Scenario& scenario,
                                           Meters depth) {
  if (o.suite && !o.worlds.empty())
    throw BadInput("--suite, --world " + o.worlds.front() + ": --suite is every world of policy/worlds; give one of the two");
  std::vector<std::filesystem::path> files(o.worlds.begin(), o.worlds.end());
  if (o.suite) {
    for (const std::filesystem::path& path : evaluate::worlds_in(host::shipped("policy/worlds"))) files.push_back(path);
  }
  std::vector<evaluate::WorldFile> worlds;
  for (std::size_t i = 0; i < files.size(); ++i) {
    for (std::size_t earlier = 0; earlier < i; ++earlier) {
      std::error_code differ;
      if (std::filesystem::equivalent(files[i], files[earlier], differ))
        throw BadInput("--world " + files[i].string() + ": is given twice");
    }
    worlds.push_back(evaluate::load_world(files[i]));
  }
  if (worlds.empty())
    worlds.push_back({.name = environment.stem().string(), .what = scenario.environment.name, .seed = 1, .scenario = scenario});
  for (evaluate::WorldFile& world : worlds) {
    world.seed = o.seed.value_or(world.seed);
    if (o.search.vehicle_depth_m || !world.vehicle_depth) world.vehicle_depth = depth;
  }
  return worlds;
}

/// Where searches went, for the files that are asked for.
struct Paths {
  std::optional<evaluate::PathTable> table;
  std::optional<evaluate::SearchesJson> searches;
};

/// Flies a candidate's searches; shows progress, and keeps the paths that are asked for.
std::vector<evaluate::Flight> fly(const evaluate::Candidate& candidate, const evaluate::Trial& trial, parallel::Ranks& ranks,
                                  Paths& paths) {
  std::optional<program::ProgressBar> bar;
  if (ranks.rank() == 0) bar.emplace(trial.file.name + ", " + candidate.name);
  const evaluate::Watcher watcher = [&](std::size_t number, const search::Episode& episode, search::EpisodeEnd end) {
    if (bar) bar->update(static_cast<double>(number) / static_cast<double>(trial.episodes));
    if (paths.table) paths.table->add(trial.file.name, candidate.name, number, episode, end);
    if (paths.searches) paths.searches->add(trial.file.name, candidate.name, number, episode, end);
  };
  return evaluate::fly(candidate, trial, ranks, watcher);
}

void write_files(const Options& o, const evaluate::EvaluationSetup& setup, const std::vector<evaluate::Row>& rows, const Paths& paths) {
  const evaluate::Timing timing = o.timing ? evaluate::Timing::kIncluded : evaluate::Timing::kLeftOut;
  if (o.json) host::write_whole(*o.json, evaluate::as_json(setup, rows, timing));
  if (o.csv) host::write_whole(*o.csv, evaluate::as_csv(rows, timing));
  if (o.paths) host::write_whole(*o.paths, paths.table->csv());
  if (o.page) host::write_whole(*o.page, report::page_with(evaluate::as_suite(setup, rows, *paths.searches), report::PageOf::kSuite));
  if (!o.plot) return;
  try {
    const std::string title = evaluate::title_of(setup);
    plot::draw(*o.plot, {.title = title, .size = "1400,1200", .commands = evaluate::as_plot(rows, title)});
  } catch (const std::runtime_error& e) {
    throw BadInput(e.what());
  }
}

constexpr host::OutputKind kFiguresOutput{"figures of earshot evaluate (JSON)", {"{\n \"episodes\"", {}}};
constexpr host::OutputKind kTableOutput{"a table of earshot evaluate (CSV)", {"world,policy,episodes,", {}}};
constexpr host::OutputKind kPathsOutput{"paths of earshot evaluate (CSV)", {"world,policy,episode,step,", {}}};

/// What was read of the files that are given.
struct Inputs {
  std::span<const evaluate::Candidate> candidates;
  const ocean::Environment& environment;
  std::span<const evaluate::WorldFile> worlds;
  std::span<const host::TablesFile> tables;
};

/// None of which may be written: --force would replace it.
host::DistinctFiles files_of(const Options& o, const Inputs& inputs) {
  host::DistinctFiles read;
  for (const evaluate::Candidate& candidate : inputs.candidates)
    if (!candidate.file.empty()) read.read("POLICY", candidate.file);
  if (o.search.environment) read.read("--environment", *o.search.environment);
  read.read("a file of the environment", inputs.environment.files);
  if (o.mission) read.read("--mission", *o.mission);
  for (const std::string& file : o.worlds) read.read("--world", file);
  for (const evaluate::WorldFile& world : inputs.worlds) read.read("the environment of a world", world.scenario.environment.files);
  for (const host::TablesFile& file : inputs.tables) read.read("--tables", file.path);
  return read;
}

void check_files(const Options& o, const Inputs& read) {
  if (o.plot) command_line::check_picture_name("--plot", *o.plot);
  std::vector<host::Output> files;
  if (o.json) files.push_back({"--json", *o.json, kFiguresOutput});
  if (o.csv) files.push_back({"--csv", *o.csv, kTableOutput});
  if (o.plot) files.push_back({"--plot", *o.plot, host::picture_kind(*o.plot)});
  if (o.paths) files.push_back({"--paths", *o.paths, kPathsOutput});
  if (o.page) files.push_back({"--page", *o.page, host::kHtmlOutput});
  host::require_writable(files_of(o, read), files, host::replaced_by(o.force));
}

/// "source fixed at 10000 m north, 10000 m east (as fixed.policy was trained); starts all over the area (as fixed.policy was trained); ..."
std::string what_is_searched(const command_line::ScenarioOptions& given, const evaluate::Task& task) {
  const search::SearchSettings& settings = task.settings;
  const auto unless = [&](bool is_given) { return is_given ? std::string() : task.as_trained; };
  std::ostringstream text;
  text << "source " << search::name_of(settings.placement);
  if (settings.placement == search::SourcePlacement::kFixed)
    text << " at " << settings.source.north.value << " m north, " << settings.source.east.value << " m east";
  text << unless(given.source.has_value());
  if (settings.listening != config::ListeningWindow{}) text << "; hears the " << host::to_string(settings.listening);
  if (task.choices.start_margin_m)
    text << "; starts " << *task.choices.start_margin_m << " m or more from every edge";
  else
    text << (search::start_placement_named(*task.choices.start) == search::StartPlacement::kDomain ? "; starts all over the area"
                                                                                                   : "; starts clear of the border");
  text << unless(given.start || given.start_margin_m) << "; border " << settings.border_width.value << " m; at most " << settings.max_steps
       << " steps\nhours to find: of all searches, - where too few found; in the mean, one that did not find counts as "
       << settings.max_steps << " steps\n";
  return text.str();
}

/// What is the same in every world.
struct Common {
  const Options& options;
  const ocean::Environment& believed;  ///< what baselines go by
  const search::SearchSettings& settings;
  std::span<const host::TablesFile* const> tables;  ///< of every world; null: its own ocean
  std::optional<policy::ActionDraw> draw;
};

/// Flies every candidate in every world, and prints the table of each world. @return on rank 0 the rows; elsewhere nothing
std::vector<evaluate::Row> fly_in_all(std::span<const evaluate::WorldFile> worlds, std::span<const evaluate::Candidate> candidates,
                                      const Common& common, parallel::Ranks& ranks, Paths& paths) {
  const Options& o = common.options;
  std::vector<evaluate::Row> rows;
  for (std::size_t i = 0; i < worlds.size(); ++i) {
    const evaluate::WorldFile& world = worlds[i];
    const host::TablesFile* const tables = common.tables[i];
    const auto searched = evaluate::searched_world(world, common.settings, common.believed);
    const evaluate::Trial trial{world, *searched, tables != nullptr ? *tables->tables : searched->own, o.episodes, common.draw};
    const evaluate::Pace pace = evaluate::pace_of(searched->world);
    const std::size_t first_row = rows.size();
    for (const evaluate::Candidate& candidate : candidates) {
      const std::vector<evaluate::Flight> flights = fly(candidate, trial, ranks, paths);
      if (ranks.rank() == 0) rows.push_back(evaluate::row_of(world.name, candidate.name, flights, pace, world.seed));
    }
    if (ranks.rank() > 0) continue;
    const std::string head = world.name + ": " + world.what + "; " + std::to_string(o.episodes) + " searches, seed " +
                             std::to_string(world.seed) + ", steps of " + host::significant(pace.step_s, 6) + " s";
    program::print() << program::wrapped_lines(head) << evaluate::as_text(std::span(rows).subspan(first_row)) << std::endl;
  }
  return rows;
}

void evaluate_policies(const Options& o, parallel::RankSession& session) {
  parallel::Ranks& ranks = session.ranks();
  const bool speaks = ranks.rank() == 0;
  for (const auto& [option, file] : {std::pair("--paths", o.paths), std::pair("--page", o.page)})
    if (file && ranks.size() > 1) throw BadInput(std::string(option) + ": not with several MPI ranks");
  std::optional<evaluate::FlownMission> mission;
  if (o.mission) mission = evaluate::read_mission(*o.mission);
  const std::vector<evaluate::Candidate> candidates = candidates_of(o, mission);
  if (!o.search.source) evaluate::check_same_source(candidates);
  const evaluate::Candidate* const leading = evaluate::leading(candidates);
  evaluate::Task task = evaluate::task_of(mission ? evaluate::with_mission(o.search, *mission) : o.search, candidates, leading);
  if (mission) evaluate::apply(*mission, candidates, task.settings);
  const std::filesystem::path environment_file =
      o.search.environment ? std::filesystem::path(*o.search.environment) : host::shipped("sim/ocean/environments/munk_flat.toml");
  const search::Scenario scenario = command_line::scenario_at(environment_file, task.depth);
  const ocean::Environment& environment = scenario.environment;
  std::vector<evaluate::WorldFile> worlds = worlds_of(o, environment_file, scenario, task.depth);
  if (mission) evaluate::apply(*mission, o.search.vehicle_depth_m.has_value(), worlds);
  task.settings.source = evaluate::source_of(leading, environment, o.search.environment.has_value());
  if (!o.search.listening.is_given() && !mission) evaluate::check_same_listening(candidates);
  command_line::apply_choices(task.choices, task.settings);
  if (o.search.listening.is_given()) task.settings.listening = o.search.listening.applied_to(task.settings.listening);
  if (o.declared) task.settings.found_by = search::FoundBy::kSearcher;
  std::vector<std::string> named_tables = o.tables;
  if (named_tables.empty() && mission && !mission->file.tables.empty()) named_tables.push_back(mission->file.tables.string());
  const evaluate::TablesGiven given = evaluate::read_tables(named_tables);
  session.all_or_none<BadInput>([&] {
    if (speaks) check_files(o, {candidates, environment, worlds, given.files});
  });
  std::vector<std::string> warnings = warnings_of(candidates, {task.settings, task.depth, host::crc32_text(environment.file_crc32)});
  if (mission && !o.search.environment && o.worlds.empty() && !o.suite) {
    if (const std::string ocean_warning = evaluate::warning_about_ocean(*mission, environment, environment_file); !ocean_warning.empty())
      warnings.push_back(ocean_warning);
  }
  const std::vector<const host::TablesFile*> tables = evaluate::tables_of_worlds(given, worlds, task.settings, warnings);
  if (speaks) {
    for (const std::string& warning : warnings) std::cerr << "earshot evaluate: warning: " << host::printable(warning) << "\n";
    for (const evaluate::Candidate& c : candidates) print_details(c);
    program::detail() << environment_file.string() << ": " << environment.name << "; the vehicle " << task.depth.value << " m deep\n"
                      << host::counted(ranks.size(), "process", "processes") << "\n";
    program::print() << program::wrapped_lines((mission ? evaluate::to_string(*mission) : "") + what_is_searched(o.search, task) +
                                               evaluate::given_oceans(candidates, environment_file, o.worlds.empty() && !o.suite));
  }
  std::optional<policy::ActionDraw> draw;
  if (o.draw) draw = description::draw_named(*o.draw);

  Paths paths;
  if (o.paths) paths.table.emplace();
  if (o.page) paths.searches.emplace();
  const std::vector<evaluate::Row> rows = fly_in_all(worlds, candidates, {o, environment, task.settings, tables, draw}, ranks, paths);
  if (speaks) {
    std::vector<std::optional<evaluate::FlownTables>> described;
    for (const host::TablesFile* file : tables) described.push_back(evaluate::described(file));
    write_files(o,
                {.episodes = o.episodes,
                 .start_margin_m = task.choices.start_margin_m,
                 .start = task.choices.start.value_or(""),
                 .settings = task.settings,
                 .vehicle_depth = task.depth,
                 .trained_by = task.trained_by,
                 .warnings = warnings,
                 .worlds = worlds,
                 .tables = described},
                rows, paths);
  }
}

}  // namespace

int main(int argc, char** argv) {
  program::CommandLine line("earshot evaluate", "Flies many simulated searches with policies and baselines and reports how they did.");
  Options options;
  add_options(line, options);
  return command_line::run_ranked(line, argc, argv, [&](parallel::RankSession& session) { evaluate_policies(options, session); });
}
