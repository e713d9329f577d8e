#include "policy/python/evaluation/evaluation_module.hpp"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <sstream>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/file/checksum_text.hpp"
#include "firmware/host/policy/tables_choice.hpp"
#include "policy/baselines/catalogue.hpp"
#include "policy/evaluate/candidates.hpp"
#include "policy/evaluate/output/table.hpp"
#include "policy/evaluate/task.hpp"
#include "policy/evaluate/trial.hpp"
#include "policy/evaluate/world_file.hpp"
#include "policy/python/belief/ocean_tables.hpp"
#include "policy/python/boundary/checked.hpp"
#include "policy/python/boundary/watch.hpp"
#include "policy/python/evaluation/python_searcher.hpp"
#include "sim/parallel/ranks.hpp"
#include "sim/search/scenario/file_kind.hpp"
#include "sim/search/scenario/placement.hpp"
#include "sim/search/scenario/scenario_file.hpp"

namespace earshot::python {
namespace {

namespace py = pybind11;
using host::BadInput;
using host::Range;

/// An environment, or a file of one.
using OceanGiven = std::variant<std::shared_ptr<ocean::Environment>, std::filesystem::path>;
/// A policy by its name or file, or a name and (begin or None, choose, declares_found or None).
using PolicyGiven = std::variant<std::string, std::pair<std::string, py::tuple>>;

/// What is evaluated, as Python gives it.
struct Asked {
  std::vector<PolicyGiven> policies;
  std::vector<OceanGiven> worlds;
  OceanGiven environment;
  std::vector<std::pair<std::string, std::shared_ptr<Tables>>> tables;
  std::size_t episodes;
  std::optional<std::uint64_t> seed;
  description::SearchChoices choices;
  bool declared;
};

std::vector<evaluate::Candidate> candidates_of(const Asked& asked) {
  std::vector<evaluate::Candidate> candidates;
  for (const PolicyGiven& policy : asked.policies) {
    if (const auto* const name = std::get_if<std::string>(&policy)) {
      candidates.push_back(evaluate::candidate_named(*name));
      continue;
    }
    const auto& [name, bound] = std::get<std::pair<std::string, py::tuple>>(policy);
    candidates.push_back({.name = name, .learned = nullptr, .make = [name = name, bound = bound](const baselines::PriorKnowledge& prior) {
                            const py::gil_scoped_acquire with_python;
                            return std::make_unique<PythonSearcher>(name, bound, prior.actions.size());
                          }});
  }
  return candidates;
}

search::Scenario scenario_of(const OceanGiven& given) {
  if (const auto* const environment = std::get_if<std::shared_ptr<ocean::Environment>>(&given)) return {.environment = **environment};
  return search::load_scenario(std::get<std::filesystem::path>(given));
}

std::string name_of(const OceanGiven& given, const search::Scenario& scenario) {
  const auto* const file = std::get_if<std::filesystem::path>(&given);
  return file != nullptr ? file->stem().string() : scenario.environment.name;
}

evaluate::WorldFile world_of(const OceanGiven& given, search::Scenario scenario) {
  return {.name = name_of(given, scenario), .what = scenario.environment.name, .seed = 1, .scenario = std::move(scenario)};
}

void require_in_water(const evaluate::WorldFile& world) {
  const Meters floor = world.scenario.environment.seabed.depth;
  if (*world.vehicle_depth < floor) return;
  std::ostringstream limit;
  limit << floor.value;
  throw BadInput(named("vehicle_depth", world.vehicle_depth->value) + "must be less than " + limit.str() +
                 " m, the depth of the sea floor in " + world.name);
}

/// @param believed  the environment's scenario: where it is searched where no world is given
std::vector<evaluate::WorldFile> worlds_of(const Asked& asked, const evaluate::Task& task, const search::Scenario& believed) {
  std::vector<evaluate::WorldFile> worlds;
  for (const OceanGiven& given : asked.worlds) {
    const auto* const file = std::get_if<std::filesystem::path>(&given);
    const bool is_world = file != nullptr && search::kind_of(*file) == search::FileKind::kWorld;
    worlds.push_back(is_world ? evaluate::load_world(*file) : world_of(given, scenario_of(given)));
  }
  if (worlds.empty()) worlds.push_back(world_of(asked.environment, believed));
  for (evaluate::WorldFile& world : worlds) {
    world.seed = asked.seed.value_or(world.seed);
    if (asked.choices.vehicle_depth_m || !world.vehicle_depth) world.vehicle_depth = task.depth;
    require_in_water(world);
  }
  return worlds;
}

std::vector<host::TablesFile> files_of(const Asked& asked) {
  std::vector<host::TablesFile> files;
  for (const auto& [name, tables] : asked.tables)
    files.push_back({.path = name, .bytes = {}, .tables = std::make_unique<policy::OceanTables>(*tables->of)});
  return files;
}

void check(const Asked& asked) {
  checked("n", static_cast<double>(asked.episodes), Range::between(1.0, 1e8));
  const description::SearchChoices& choices = asked.choices;
  if (choices.source && !search::placement_named(*choices.source))
    throw BadInput("source = \"" + *choices.source + "\": must be \"fixed\" or \"changing\"");
  if (choices.start && !search::start_placement_named(*choices.start))
    throw BadInput("start = \"" + *choices.start + "\": must be \"domain\" or \"inside_border\"");
  if (choices.vehicle_depth_m) checked("vehicle_depth", *choices.vehicle_depth_m, Range::between(0.1, 12'000.0));
  if (choices.border_width_m) checked("border_width", *choices.border_width_m, Range::between(0.1, 1e6));
  if (choices.max_steps) checked("max_steps", *choices.max_steps, Range::between(1.0, 1e6));
}

/// CSV, and what is warned of.
std::pair<std::string, std::vector<std::string>> evaluated(const Asked& asked, const std::vector<evaluate::Candidate>& candidates,
                                                           Watch& watch) {
  check(asked);
  if (!asked.choices.source) evaluate::check_same_source(candidates);
  evaluate::check_same_listening(candidates);
  const evaluate::Candidate* const leading = evaluate::leading(candidates);
  evaluate::Task task = evaluate::task_of(asked.choices, candidates, leading);
  const search::Scenario believed = scenario_of(asked.environment);
  const std::vector<evaluate::WorldFile> worlds = worlds_of(asked, task, believed);
  task.settings.source = evaluate::source_of(leading, believed.environment, asked.worlds.empty());
  if (!description::apply(task.choices, task.settings))
    throw BadInput("border_width, start: nothing of the area is left to start in, or all of it lies within a step of the source");
  if (asked.declared) task.settings.found_by = search::FoundBy::kSearcher;
  std::vector<std::string> warnings;
  for (const evaluate::Candidate& candidate : candidates)
    for (std::string& difference :
         evaluate::differences(candidate, {task.settings, task.depth, host::crc32_text(believed.environment.file_crc32)}))
      warnings.push_back(std::move(difference));
  const std::vector<host::TablesFile> files = files_of(asked);
  parallel::Alone alone;
  std::vector<evaluate::Row> rows;
  const auto searches = static_cast<double>(worlds.size() * candidates.size() * asked.episodes);
  for (const evaluate::WorldFile& world : worlds) {
    const auto searched = evaluate::searched_world(world, task.settings, believed.environment);
    const policy::OceanTables& oceans =
        files.empty() ? searched->own : *host::tables_for(files, evaluate::sound_of(world, task.settings), "tables: " + world.name).tables;
    const evaluate::Trial trial{world, *searched, oceans, asked.episodes, std::nullopt};
    for (const evaluate::Candidate& candidate : candidates) {
      const auto before = static_cast<double>(rows.size() * asked.episodes);
      const std::vector<evaluate::Flight> flights =
          evaluate::fly(candidate, trial, alone, [&](std::size_t number, const search::Episode&, search::EpisodeEnd) {
            watch((before + static_cast<double>(number)) / searches);
          });
      rows.push_back(
          evaluate::row_of(world.name, candidate.name, flights, evaluate::pace_of(searched->world), world.seed, [&] { watch(); }));
    }
  }
  watch(1.0);
  return {evaluate::as_csv(rows, evaluate::Timing::kIncluded), warnings};
}

/// How many evaluations are under way in this thread: a policy may begin one, and each takes some 200 kB of the stack.
class Nesting {
 public:
  Nesting() {
    constexpr int kMost = 8;
    if (depth_ >= kMost) throw BadInput("policies: must not evaluate policies that evaluate policies, more than 8 deep");
    ++depth_;
  }
  Nesting(const Nesting&) = delete;
  Nesting& operator=(const Nesting&) = delete;
  ~Nesting() { --depth_; }

 private:
  static thread_local int depth_;
};
thread_local int Nesting::depth_ = 0;

py::tuple evaluate_policies(std::vector<PolicyGiven> policies, std::vector<OceanGiven> worlds, OceanGiven environment,
                            std::vector<std::pair<std::string, std::shared_ptr<Tables>>> tables, std::size_t episodes,
                            std::optional<std::uint64_t> seed, std::optional<double> vehicle_depth, std::optional<std::string> source,
                            std::optional<std::string> start, std::optional<double> border_width, std::optional<std::uint32_t> max_steps,
                            bool declared, py::object progress) {
  const Asked asked{.policies = std::move(policies),
                    .worlds = std::move(worlds),
                    .environment = std::move(environment),
                    .tables = std::move(tables),
                    .episodes = episodes,
                    .seed = seed,
                    .choices = {.vehicle_depth_m = vehicle_depth,
                                .source = std::move(source),
                                .start = std::move(start),
                                .border_width_m = border_width,
                                .max_steps = max_steps},
                    .declared = declared};
  const Nesting nesting;
  const std::vector<evaluate::Candidate> candidates = candidates_of(asked);
  Watch watch(std::move(progress));
  const auto [csv, warnings] = [&] {
    const py::gil_scoped_release without_python;
    return evaluated(asked, candidates, watch);
  }();
  return py::make_tuple(csv, warnings);
}

py::dict baselines_by_name() {
  py::dict all;
  for (const baselines::Entry& entry : baselines::catalogue()) all[py::str(std::string(entry.name))] = std::string(entry.what);
  return all;
}

}  // namespace

void add_evaluation(py::module_& module) {
  module.def("baselines", &baselines_by_name);
  module.def("evaluate", &evaluate_policies, py::kw_only(), py::arg("policies"), py::arg("worlds"), py::arg("environment"),
             py::arg("tables"), py::arg("episodes"), py::arg("seed"), py::arg("vehicle_depth"), py::arg("source"), py::arg("start"),
             py::arg("border_width"), py::arg("max_steps"), py::arg("declared"), py::arg("progress"));
}

}  // namespace earshot::python
