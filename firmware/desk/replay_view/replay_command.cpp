#include "firmware/desk/replay_view/replay_command.hpp"

#include <chrono>
#include <functional>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "firmware/boards/linux/replay/replay.hpp"
#include "firmware/desk/replay_view/counterfactual.hpp"
#include "firmware/desk/replay_view/decision_table.hpp"
#include "firmware/desk/replay_view/findings.hpp"
#include "firmware/desk/replay_view/parting_map.hpp"
#include "firmware/desk/replay_view/replay_json.hpp"
#include "firmware/desk/replay_view/step_pair.hpp"
#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/file/distinct_files.hpp"
#include "firmware/host/file/printable.hpp"
#include "firmware/host/journal/journal_parts.hpp"
#include "firmware/host/mission/mission_file.hpp"
#include "firmware/host/mission/policy_file.hpp"
#include "firmware/host/mission/tables_file.hpp"
#include "firmware/host/policy/tables_bytes.hpp"
#include "firmware/host/policy/unverified_policy.hpp"
#include "firmware/host/program/exit_status.hpp"
#include "firmware/host/program/progress_bar.hpp"
#include "firmware/host/program/talk.hpp"
#include "firmware/host/program/wrapped.hpp"

namespace earshot::replay_view {
namespace {

using Json = nlohmann::ordered_json;

std::string shown(const std::filesystem::path& path) {
  return host::printable(path.string());
}

/// @param mission  that --mission names; nothing: none is named
void judge_outputs(const ReplayCommand& c, const std::optional<host::MissionFile>& mission) {
  const bool asks_what_if = c.policy || c.tables || c.mission;
  if (c.map && !asks_what_if) throw host::BadInput("--map: only with --policy, --tables or --mission");
  host::DistinctFiles read;
  read.read("JOURNAL", host::JournalParts(c.journal).files());
  if (c.policy) read.read("--policy", *c.policy);
  if (c.tables) read.read("--tables", *c.tables);
  if (c.mission) read.read("--mission", *c.mission);
  if (mission && mission->command_key) read.read("the command key of --mission", mission->command_key_file);
  std::vector<host::Output> outputs;
  if (c.map) outputs.push_back({"--map", *c.map, host::kSvgOutput});
  if (c.json) outputs.push_back({"--json", *c.json, kReplayOutput});
  host::require_writable(std::move(read), outputs, c.replace);
}

/// What is asked about in place of what was flown.
struct Question {
  Plan plan;
  std::string words;     ///< "the policy at/sea/other.policy and the journal's mission"
  std::string replaced;  ///< in place of what was flown, by its files' names: "policy other.policy"
};

/// @throws host::BadInput as earshotd would refuse to fly it.
std::optional<Question> question_of(const ReplayCommand& c, const std::optional<host::MissionFile>& mission) {
  if (!c.policy && !c.tables && !c.mission) return std::nullopt;
  Question question{.plan = plan_of(c.journal), .words = {}, .replaced = {}};
  Plan& plan = question.plan;
  if (mission) {
    // Another draw of a policy's dice would be another flight: only what is asked about shall differ.
    const std::uint64_t seed = plan.mission.action_seed;
    plan.mission = mission->mission;
    plan.mission.action_seed = seed;
  }
  if (c.policy) plan.policy = host::load_unverified_policy(*c.policy);
  host::check_fits(*plan.policy, c.policy.value_or("of " + c.journal.string()), plan.mission, c.mission.value_or(c.journal));
  if (c.tables) plan.tables = host::tables_from(host::read_tables_bytes(*c.tables), *c.tables);
  if (policy::needs_belief(plan.policy->observation.spec)) {
    if (plan.tables->tables.empty()) throw host::BadInput("--tables: the journal's policy needed none, and this one searches by some");
    host::require_coverage(*plan.tables, c.tables.value_or("of " + c.journal.string()), policy::searched_sound(plan.mission));
  }
  question.words = (c.policy ? "the policy " + shown(*c.policy) : "the journal's policy") +
                   (c.tables ? ", the ocean tables " + shown(*c.tables) : "") + " and " +
                   (c.mission ? "the mission " + shown(*c.mission) : "the journal's mission");
  for (const auto& [kind, file] :
       {std::pair("policy ", &c.policy), std::pair("ocean tables ", &c.tables), std::pair("mission ", &c.mission)}) {
    if (*file) question.replaced += (question.replaced.empty() ? "" : ", ") + (kind + shown((*file)->filename()));
  }
  return question;
}

struct Timed {
  board::ReplayResult result;
  double took_s = 0.0;
};

Timed replay_once(const ReplayCommand& c) {
  program::ProgressBar bar("replay");
  const auto began = std::chrono::steady_clock::now();
  Timed timed{.result = board::replay(c.journal, {.from_step = c.from_step, .progress = [&bar](double done) { bar.update(done); }})};
  timed.took_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  return timed;
}

/// @return exit status
int report(const ReplayCommand& c, const Timed& timed) {
  const board::ReplayResult& result = timed.result;
  if (!result.was_compared && result.is_same())
    throw host::BadInput("--from " + std::to_string(c.from_step) + ": no such step is decided; there are " +
                         std::to_string(result.decisions) + ", the first is step 0");
  program::print() << shown(c.journal) << ": " << figures(result, timed.took_s) << "\n";
  const std::vector<std::string> wrong = findings(result);
  if (!result.difference && result.was_compared) program::print() << praise(result, c.from_step) << "\n";
  program::print().flush();
  for (const std::string& line : wrong) std::cerr << shown(c.journal) << ": " << line << "\n";
  return wrong.empty() ? program::kDone : program::kIncomplete;
}

Json report_what_if(const ReplayCommand& c, const Question& question) {
  Counterfactual counterfactual;
  {
    program::ProgressBar bar("what if");
    counterfactual = fly_again(c.journal, question.plan, [&bar](double done) { bar.update(done); });
  }
  const std::vector<StepPair> pairs = paired(counterfactual.then, counterfactual.now);
  program::print() << "\nthe same inputs, with " << question.words << ":\n"
                   << program::wrapped_lines(where_they_part(pairs, c.from_step, counterfactual.began)) << "\n"
                   << decision_table(pairs, c.from_step, counterfactual.began) << "\n"
                   << program::wrapped_lines(what_it_means(counterfactual, pairs));
  if (c.map) {
    const std::string title = shown(c.journal.filename()) + ": decided then, and now with " + question.replaced;
    host::write_whole(*c.map, parting_map(counterfactual, pairs, c.from_step, question.plan.mission.operating_area, title));
  }
  Json json{{"policy", c.policy ? Json(c.policy->string()) : Json()},
            {"tables", c.tables ? Json(c.tables->string()) : Json()},
            {"mission", c.mission ? Json(c.mission->string()) : Json()}};
  json.update(what_if_json(counterfactual, pairs, c.from_step));
  return json;
}

}  // namespace

int replay(const ReplayCommand& c) {
  std::optional<host::MissionFile> mission;
  if (c.mission) mission = host::load_mission(*c.mission);
  judge_outputs(c, mission);
  const std::optional<Question> question = question_of(c, mission);
  const Timed timed = replay_once(c);
  const int status = report(c, timed);
  Json what_if;
  if (question) what_if = report_what_if(c, *question);
  if (c.json) host::write_whole(*c.json, replay_text(replay_json(timed.result, timed.took_s, c.from_step), std::move(what_if)));
  for (const auto* written : {&c.map, &c.json}) {
    if (*written) program::print() << shown(**written) << " written\n";
  }
  return status;
}

}  // namespace earshot::replay_view
