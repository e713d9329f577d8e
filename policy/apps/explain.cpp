// earshot-explain: what a policy does, and why it did it.

#include <array>
#include <ostream>
#include <utility>

#include "firmware/host/file/distinct_files.hpp"
#include "firmware/host/file/printable.hpp"
#include "firmware/host/file/shipped.hpp"
#include "firmware/host/program/talk.hpp"
#include "firmware/host/toml/table_reader.hpp"
#include "policy/command_line/outputs.hpp"
#include "policy/command_line/place.hpp"
#include "policy/command_line/policy_details.hpp"
#include "policy/command_line/run.hpp"
#include "policy/report/decision_report.hpp"
#include "policy/report/document/flight_reading.hpp"
#include "policy/report/document/json_values.hpp"
#include "policy/report/explanation.hpp"
#include "policy/report/map/policy_map.hpp"
#include "policy/report/page/page_template.hpp"
#include "policy/report/recorded_flight.hpp"

namespace {

using namespace earshot;
using host::BadInput;

struct DecisionOptions {
  std::filesystem::path flight;
  std::uint32_t step = 0;
  std::optional<std::filesystem::path> policy;
  std::optional<std::filesystem::path> tables;
  std::optional<std::string> south_west;
  std::string baseline = "centre";
  std::filesystem::path output;
  bool force = false;
};

program::CommandLine& add_map(program::CommandLine& line, report::PolicyMapOptions& o) {
  program::CommandLine& map = line.verb("map", "draws where a policy goes all over its area, beside what is heard there");
  map.option("POLICY", &o.policy, "frozen policy (.policy)").required();
  map.option("--source", &o.source,
             "NORTH_M,EAST_M of a source (metres; 10km,10km is the same as 10000,10000), from the south-west corner of the policy's area: "
             "the policy's choice at each place or, where that hangs "
             "on what it has heard before, its paths from starts all over the area");
  map.option("--flight", &o.flight,
             "folder of a flight with this policy, instead of --source: its choice anywhere with what it believed at --step");
  map.option("--step", &o.step, "step of the flight").shows_default();
  map.option(
         "--tables", &o.tables,
         "ocean tables (.tables) by which a policy with a belief searches; those of a flight are beside its journal; default: those that "
         "ship for 20 Hz at a depth of 300 m")
      .names("a file");
  const program::Option environment =
      map.option("--environment", &o.environment, "environment file (TOML): the ocean, instead of the likeliest one of the tables");
  map.option("--world", &o.world,
             "world of policy/worlds instead of an environment; its conditions are left out: what is heard is the mean")
      .excludes(environment);
  map.option("--vehicle-depth-m", &o.vehicle_depth_m, "depth of the vehicle in that ocean, metres").positive().shows_default();
  map.option("--arrows", &o.arrows, "arrows along a side").from(1, 100).shows_default();
  map.option("--starts", &o.starts, "starts of paths along a side").from(1, 50).shows_default();
  map.option("-o,--output", &o.output, "picture to write (.png or .svg)").required();
  map.flag("--force", &o.force, command_line::kForceHelp);
  return map;
}

void add_decision(program::CommandLine& line, DecisionOptions& o) {
  program::CommandLine& decision = line.verb(
      "decision",
      "writes a report about one decision of a flight: heard, believed, chosen, expected, and why; of HTML the flight's page, opened at "
      "it");
  decision.option("FLIGHT", &o.flight, "folder of a flight, or its journal (.lcmlog)").required();
  decision.option("--step", &o.step, "which decision; the first is 0").required();
  decision.option("--policy", &o.policy, "policy that flew; default: the .policy beside the journal");
  decision.option("--tables", &o.tables, "ocean tables that it searched by; default: the .tables beside the journal").names("a file");
  decision.option("--south-west", &o.south_west,
                  "NORTH_M,EAST_M of the area's south-west corner; default: summary.json's, or 0,0 for a journal alone");
  decision
      .option("--baseline", &o.baseline,
              "what the observation is compared with: a vehicle that has heard nothing, in the area's centre or here")
      .one_of({"centre", "here"})
      .shows_default();
  decision.option("-o,--output", &o.output, "report to write (.html, .md or .json)").required();
  decision.flag("--force", &o.force, command_line::kForceHelp);
}

/// The page of the whole flight, opened at the decision.
std::string page_at(const DecisionOptions& o, const report::RecordingOptions& recording, explain::Baseline baseline) {
  report::FlightSurroundings around = report::surroundings_of(o.flight);
  around.recording = recording;
  around.baseline = baseline;
  around.open_at_step = o.step;
  return report::page_with(report::json_text(report::read_to_its_end(std::move(around))->whole()));
}

host::OutputKind report_kind(const std::string& extension) {
  if (extension == ".html") return host::kHtmlOutput;
  if (extension == ".md") return {"a report of earshot explain (Markdown)", {"# Step ", {}}};
  return {"a report of earshot explain (JSON)", {"{\n \"step\"", {}}};
}

void write_decision_report(const DecisionOptions& o) {
  const std::string extension = o.output.extension().string();
  if (extension != ".html" && extension != ".md" && extension != ".json")
    throw BadInput("-o " + o.output.string() + ": must end in .html, .md or .json");
  host::DistinctFiles read;
  if (o.policy) read.read("--policy", *o.policy);
  if (o.tables) read.read("--tables", *o.tables);
  read.read("FLIGHT", report::files_of_flight(o.flight));
  host::require_writable(std::move(read), std::array{host::Output{"--output", o.output, report_kind(extension)}},
                         host::replaced_by(o.force));
  report::RecordingOptions recording{.policy = o.policy, .tables = o.tables, .south_west = std::nullopt};
  if (o.south_west) recording.south_west = command_line::north_east_of("--south-west", *o.south_west);
  const report::RecordedFlight flight = report::open_recording(o.flight, recording);
  command_line::print_policy_details(flight.policy_path.string(), *flight.policy);
  program::detail() << flight.journal_path.string() << ": " << flight.journal.decisions.size()
                    << " decisions, each as the policy makes it again\n";
  const explain::Baseline baseline = o.baseline == "here" ? explain::Baseline::kHere : explain::Baseline::kCentre;
  const report::DecisionReport made = report::make_decision_report(flight, report::index_of_step(flight, o.step), baseline);
  host::write_whole(o.output, extension == ".html" ? page_at(o, recording, baseline)
                              : extension == ".md" ? report::as_markdown(made)
                                                   : report::as_json(made));
  for (const std::string& sentence : report::sentences(made.account)) program::print() << sentence << "\n";
  const explain::Attribution& parts = made.account.attribution;
  (parts.is_complete() ? program::detail() : program::print())
      << "Integrated gradients: " << report::completeness_to_string(parts) << ".\n";
  program::print() << "wrote " << host::printable(o.output.string()) << ": step " << o.step << " of "
                   << host::printable(flight.journal_path.string()) << "\n";
}

}  // namespace

int main(int argc, char** argv) {
  program::CommandLine line("earshot explain", "Draws what a policy does, and explains why one recorded decision was taken.");
  line.footer(
      "Examples:\n"
      "  earshot explain map policy/frozen/fixed_source.policy --source 10000,10000 --environment sim/ocean/environments/munk_flat.toml -o "
      "map.png\n"
      "  earshot explain decision out --step 4 -o decision.html");
  report::PolicyMapOptions map_options;
  DecisionOptions decision_options;
  const program::CommandLine& map = add_map(line, map_options);
  add_decision(line, decision_options);
  return command_line::run(line, argc, argv, [&] {
    if (!map.is_chosen()) return write_decision_report(decision_options);
    if (map_options.tables.empty()) map_options.tables = host::shipped("policy/tables/shipped/20hz_300m.tables");
    report::draw_policy_map(map_options);
  });
}
