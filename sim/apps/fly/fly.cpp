// earshot-fly: one search from start to report: earshot-sim, earshotd, what happened.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/file/printable.hpp"
#include "firmware/host/file/shipped.hpp"
#include "firmware/host/mission/mission_file.hpp"
#include "firmware/host/mission/policy_file.hpp"
#include "firmware/host/mission/ports/flight_needs.hpp"
#include "firmware/host/mission/ports/port_override.hpp"
#include "firmware/host/program/child_process.hpp"
#include "firmware/host/program/run.hpp"
#include "firmware/host/program/signals.hpp"
#include "firmware/host/transport/bus_lock.hpp"
#include "firmware/host/transport/lcm_url.hpp"
#include "firmware/policy/tables/ocean_tables.hpp"
#include "sim/apps/fly/emulated_board.hpp"
#include "sim/apps/fly/flight_folder.hpp"
#include "sim/apps/fly/flight_page.hpp"
#include "sim/apps/fly/flight_plan.hpp"
#include "sim/apps/fly/flight_summary.hpp"
#include "sim/apps/fly/hearing/hear_option.hpp"
#include "sim/apps/fly/hearing/sound.hpp"
#include "sim/apps/fly/other_process.hpp"
#include "sim/apps/fly/speed_option.hpp"
#include "sim/link/run_slot.hpp"
#include "sim/search/scenario/scenario_file.hpp"

namespace {

using namespace earshot;
namespace fs = std::filesystem;

using fly::FlightFolder;
using program::ChildProcess;
using program::stop_requested;

struct Options {
  fs::path environment;
  fs::path mission;
  fs::path out = "out";
  std::uint64_t seed = 1;
  std::string source = "changing";
  std::string speed = "0";
  std::optional<fs::path> policy;
  std::optional<fs::path> tables;
  std::optional<fs::path> public_key;
  std::optional<fs::path> vehicle;
  std::optional<std::string> bus;
  std::optional<std::string> lcm_url;
  std::optional<std::string> can_interface;
  std::optional<std::string> journal_survives;
  std::optional<std::string> hear;
  std::optional<std::string> board;
  std::optional<double> battery_percent;
  std::optional<std::uint32_t> end_with;
  bool ignore_source = false;
  bool no_report = false;
  bool watch = false;
};

void declare(program::CommandLine& line, Options& o) {
  line.option("--environment", &o.environment, "ocean, source and noise (TOML); default: the paper's ocean, munk_flat.toml");
  line.option("--mission", &o.mission,
              "area, depth, speed, limits, ports, policy (TOML); default: search.toml; with --hear hear_tone.toml, or "
              "hear_calls.toml for calls with pauses and recorded ones");
  line.option("--out", &o.out,
              "folder for journal.lcmlog, journal.policy, journal.tables, track.csv, snr.csv, summary.json, report.html and, "
              "with --hear, hearing.csv and spectrogram.csv")
      .checked([](const std::string& folder) { return std::string(folder.empty() ? "must name a folder" : ""); })
      .shows_default();
  line.option("--seed", &o.seed, "where source and vehicle start, and how a policy that draws its actions draws them")
      .from(0, std::numeric_limits<std::int64_t>::max())
      .shows_default();
  line.option("--source", &o.source, "changing: drawn with the seed, uniform in the mission's area; fixed: where the environment has it")
      .one_of({"changing", "fixed"})
      .shows_default();
  line.option("--hear", &o.hear, fly::kHearHelp).checked(fly::hear_complaint, fly::kHearsAllowed);
  line.option("--speed", &o.speed, "simulated seconds per second; 0: as fast as it goes")
      .checked(fly::speed_complaint, fly::kSpeedsAllowed)
      .shows_default();
  line.option("--policy", &o.policy, "policy file instead of the mission's");
  line.option("--tables", &o.tables, "ocean tables instead of the mission's: a file, or a folder of which one covers the mission")
      .names("a file or a folder");
  line.option("--public-key", &o.public_key, "file of the public key that signed it, instead of the mission's");
  line.option("--vehicle", &o.vehicle,
              "the vehicle's configuration (TOML): whose missions and policies it flies; what is signed draws with the mission's own seed");
  line.option(
          "--bus", &o.bus,
          "instead of the mission's ports: all over LCM, all over CAN, or navigation over CAN and the rest over LCM; not a hydrophone's")
      .one_of({"lcm", "can", "mixed"});
  line.option("--lcm-url", &o.lcm_url, "LCM address; default: one that no other flight on this machine uses");
  line.option("--can-interface", &o.can_interface, "CAN interface instead of the mission's; vcan0 stands in for can0, the bus at sea");
  line.option("--journal-survives", &o.journal_survives,
              "power-cut: the journal is written as at sea; process: it is left to the kernel; default: process")
      .one_of({"power-cut", "process"});
  line.option("--board", &o.board,
              "a microcontroller decides, emulated: qemu-m7 with the capacities of a vehicle computer, qemu-m7-small with its own (25 x 25 "
              "cells)")
      .one_of({fly::kBoardFull, fly::kBoardSmall});
  line.option("--battery-percent", &o.battery_percent, fly::kBatteryHelp).between(0.0, 100.0);
  line.option("--end-with", &o.end_with, "number of a process: when that ends, killed or not, the flight ends in order, as with Ctrl-C")
      .from(1, std::numeric_limits<std::int32_t>::max());
  line.flag("--ignore-source", &o.ignore_source, "fly on to the last step even when the source is found (benchmarks)");
  line.flag("--no-report", &o.no_report, "do not write report.html");
  line.flag("--watch", &o.watch, "show it in a browser while it is flown; the page then stays until Ctrl-C");
}

/// Where the two processes of a flight find each other, and where they write.
struct Meeting {
  std::uint32_t domain = 0;
  std::string lcm_url;
  std::string hydrophone_url;
  link::RunId run = link::new_run();
  fs::path folder;
  std::optional<fs::path> board;  ///< serial line of the microcontroller that decides
};

template <class Value>
void add(std::vector<std::string>& arguments, const char* name, const std::optional<Value>& value) {
  if (value) arguments.insert(arguments.end(), {name, std::string(*value)});
}

std::vector<std::string> common_arguments(const Options& o, const Meeting& meeting) {
  std::vector<std::string> a{"--out", meeting.folder, "--lcm-url", meeting.lcm_url, "--run", std::to_string(meeting.run)};
  add(a, "--bus", o.bus);
  add(a, "--can-interface", o.can_interface);
  add(a, "--vehicle", o.vehicle);
  if (o.hear) a.insert(a.end(), {"--hydrophone-url", meeting.hydrophone_url});
  return a;
}

std::vector<std::string> simulator_arguments(const Options& o, const Meeting& meeting) {
  std::vector<std::string> a = common_arguments(o, meeting);
  a.insert(a.end(), {"--environment", o.environment.string(), "--mission", o.mission.string(), "--domain", std::to_string(meeting.domain),
                     "--seed", std::to_string(o.seed), "--source", o.source, "--speed", o.speed});
  add(a, "--hear", o.hear);
  if (o.board) a.emplace_back("--slow-runtime");
  if (o.battery_percent) a.insert(a.end(), {"--battery-percent", std::to_string(*o.battery_percent)});
  if (o.ignore_source) a.emplace_back("--ignore-source");
  if (program::talk() == program::Talk::kQuiet) a.emplace_back("--quiet");
  return a;
}

std::vector<std::string> runtime_arguments(const Options& o, const Meeting& meeting) {
  constexpr const char* kWait_s = "86400";  // this program looks after both
  std::vector<std::string> a = common_arguments(o, meeting);
  a.insert(a.end(), {o.mission.string(), "--quiet", "--simulation", std::to_string(meeting.domain), "--wait", kWait_s});
  add(a, "--policy", o.policy);
  add(a, "--tables", o.tables);
  add(a, "--public-key", o.public_key);
  if (!o.vehicle) a.insert(a.end(), {"--seed", std::to_string(o.seed)});  // a signed mission names its own
  add(a, "--journal-survives", o.journal_survives);
  if (o.hear) a.emplace_back("--hear");
  if (meeting.board) a.insert(a.end(), {"--board", *meeting.board});
  return a;
}

/// Waits for both. Ctrl-C goes to the simulator, which tells earshotd to abort; whoever is left when the other has gone is asked to end,
/// and ended some seconds later.
/// @param owner  whose end is a Ctrl-C, too
void wait_for_both(ChildProcess& simulator, ChildProcess& runtime, const std::optional<fly::OtherProcess>& owner) {
  using std::chrono::steady_clock;
  constexpr auto kGrace = std::chrono::seconds(6);  // longer than either takes to notice by itself that the other is gone
  std::optional<steady_clock::time_point> deadline;
  while (simulator.running() || runtime.running()) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    simulator.poll();
    runtime.poll();
    if (owner && owner->has_ended()) stop_requested = true;
    if (stop_requested) simulator.stop();
    if (simulator.status() > 0) runtime.stop();
    if (runtime.status() > 0) simulator.stop();
    if (!deadline && (stop_requested || !simulator.running() || !runtime.running())) deadline = steady_clock::now() + kGrace;
    if (deadline && steady_clock::now() > *deadline) {
      simulator.signal(SIGKILL);
      runtime.signal(SIGKILL);
    }
  }
}

void print_summary(const fs::path& out) {
  if (program::talk() == program::Talk::kQuiet) return;
  std::ifstream stream(out / "summary.json");
  std::printf("%s", fly::to_string_of_summary(nlohmann::json::parse(stream)).c_str());
}

bool writes_report(const fs::path& folder) {
  // A folder is not an option; and it is not yet where the page will be, which the flight says itself.
  ChildProcess report("earshot-report",
                      {"--quiet", folder.native().starts_with('-') ? (fs::path(".") / folder).string() : folder.string()});
  while (report.running()) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    report.poll();
  }
  return report.status() == program::kDone || report.status() == program::kIncomplete;  // the page is written, and says what it lacks
}

/// A mission that ended in ABORT is flown, too; what ended it stands in the summary.
bool is_flown(const ChildProcess& simulator, const ChildProcess& runtime) {
  const bool has_ended =
      runtime.status() == program::kDone || runtime.status() == program::kAborted || runtime.status() == program::kInterrupted;
  return simulator.status() == program::kDone && has_ended;
}

/// A process that we ended because the other refused its input has a status of its own; the refusal is what counts.
int exit_status(const ChildProcess& simulator, const ChildProcess& runtime, bool has_flown) {
  if (stop_requested) return program::kStopped;
  if (!has_flown && (simulator.status() == program::kBadInput || runtime.status() == program::kBadInput)) return program::kBadInput;
  return is_flown(simulator, runtime) ? program::kDone : program::kLost;
}

/// The LCM address that somebody chose; what a mission at sea uses when nobody did is never a simulation's.
std::optional<std::string> chosen_url(const Options& o, const host::MissionFile& mission) {
  if (o.lcm_url) return o.lcm_url;
  for (const std::string& url : host::addresses_of(mission.ports, host::PortKind::kLcm)) {
    if (url != host::kDefaultLcmUrl) return url;
  }
  return std::nullopt;
}

/// A simulation puts no frames on the bus that a vehicle has at sea unless somebody says so.
std::string chosen_can_interface(const Options& o, const host::MissionFile& mission) {
  if (o.can_interface) return *o.can_interface;
  for (const std::string& interface : host::addresses_of(mission.ports, host::PortKind::kCan)) {
    if (interface != host::kDefaultCanInterface) return interface;
  }
  return "vcan0";
}

/// Holds the buses that somebody chose; a run slot holds its own.
std::vector<host::BusLock> lock_buses(const Options& o, const host::MissionFile& mission) {
  std::vector<host::BusLock> locks;
  if (!host::addresses_of(mission.ports, host::PortKind::kCan).empty()) locks.push_back(host::lock_can(chosen_can_interface(o, mission)));
  const std::optional<std::string> url = chosen_url(o, mission);
  if (url && !host::addresses_of(mission.ports, host::PortKind::kLcm).empty()) locks.push_back(host::lock_lcm(*url));
  for (host::BusLock& lock : locks) lock.leave_to_children();
  return locks;
}

/// Reports on a flight that has begun, and keeps it if every file of it is whole. @return false when one is not
bool conclude(const Options& o, FlightFolder& folder, bool is_whole) {
  print_summary(folder.unfinished());
  const bool has_report = !o.no_report && writes_report(folder.unfinished());
  const bool is_kept = is_whole && (has_report || o.no_report);
  if (is_kept) folder.keep();
  const fs::path place = is_kept ? o.out : folder.unfinished();
  if (has_report && program::talk() != program::Talk::kQuiet) std::printf("  report      %s\n", (place / "report.html").c_str());
  return is_kept;
}

/// Says when the policy is about to search for another kind of source than its provenance names: it never learned that.
void warn_of_another_source(const Options& o, const host::MissionFile& mission) try {
  const fs::path path = o.policy.value_or(mission.policy);
  const host::SignedPolicy policy = host::load_policy(path, o.public_key.value_or(mission.public_key));
  const std::string lines = "\n" + std::string(policy.policy->provenance.begin(), policy.policy->provenance.end()) + "\n";
  for (const std::string trained : {"fixed", "changing"}) {
    if (trained == o.source || lines.find("\nsource = " + trained + "\n") == std::string::npos) continue;
    std::cerr << "earshot fly: warning: " << host::printable(path.string()) << " was trained with a " << trained << " source; use --source "
              << trained << "\n";
  }
} catch (const host::BadInput&) {
  // earshotd refuses it, and says why.
}

/// Says when the mission listens for another frequency than the source has: its ocean tables are of none that is there.
void warn_of_another_frequency(const Options& o, const fly::FlightPlan& plan) {
  const double has_hz = plan.scenario.environment.source.frequency.value;
  const double listens_hz = plan.mission.mission.source_frequency.value;
  if (std::abs(has_hz - listens_hz) <= policy::kFrequencyTolerance * listens_hz) return;
  std::ostringstream text;
  text << "earshot fly: warning: " << host::printable(o.mission.string()) << ": search.source_frequency_hz = " << listens_hz
       << ", and the source of " << host::printable(o.environment.string()) << " has " << has_hz
       << " Hz: the vehicle believes in what is heard of another source\n";
  std::cerr << text.str();
}

/// Recorded calls and songs have pauses in which the noise is heard alone; a tone has none.
const char* default_mission(const Options& o) {
  if (!o.hear) return "firmware/boards/linux/missions/search.toml";
  const bool is_tone = fly::recording_of(*o.hear).empty() && !search::load_scenario(o.environment).conditions.calls;
  return is_tone ? "firmware/boards/linux/missions/hear_tone.toml" : "firmware/boards/linux/missions/hear_calls.toml";
}

/// A detector that learns the noise of its band in the pauses takes what never pauses for noise, and hears nothing.
void require_pauses(const Options& o, const fly::FlightPlan& plan, const detector::SoundSettings& listening) {
  const bool has_pauses = !fly::recording_of(*o.hear).empty() || plan.scenario.conditions.calls.has_value();
  if (has_pauses || listening.noise_reference == detector::NoiseReference::kFlanks) return;
  throw host::BadInput(
      "--hear synthetic: " + o.mission.string() + ": hydrophone: learns the noise in the pauses between calls, and the source of " +
      o.environment.string() +
      " never pauses: take the mission hear_tone.toml, or an environment with conditions.calls (policy/worlds/pulses.toml)");
}

/// A recording is heard as it is; a source that is simulated has its environment's frequency.
void require_band_of_source(const Options& o, const fly::FlightPlan& plan, const detector::SoundSettings& listening) {
  const double has_hz = plan.scenario.environment.source.frequency.value;
  const bool is_in_band = has_hz >= listening.band.low.value && has_hz <= listening.band.high.value;
  if (is_in_band || !fly::recording_of(*o.hear).empty()) return;
  std::ostringstream text;
  text << "--hear synthetic: " << o.mission.string() << ": hydrophone: listens from " << listening.band.low.value << " to "
       << listening.band.high.value << " Hz, and source.frequency_hz of " << o.environment.string() << " is " << has_hz
       << ": the vehicle would hear nothing of it";
  throw host::BadInput(text.str());
}

/// Both processes would say the same about a bad file: say it once, before either starts.
host::MissionFile checked_mission(const Options& o) {
  const fly::FlightPlan plan = fly::load_flight_plan(o.mission, o.environment, o.vehicle);
  fly::require_left_alone(plan, o.mission, fly::recording_of(o.hear.value_or(fly::kSynthetic)), o.out);
  warn_of_another_frequency(o, plan);
  host::MissionFile mission = plan.mission;
  if (o.battery_percent) fly::require_known_consumption(mission.mission, o.mission);
  host::override_ports(mission, {.bus = o.bus, .lcm_url = std::nullopt, .can_interface = std::nullopt});
  if (o.hear) {
    host::require_hydrophone(mission, o.mission);
    require_pauses(o, plan, *mission.hearing);
    require_band_of_source(o, plan, *mission.hearing);
    (void)fly::calls_of(fly::recording_of(*o.hear), plan.scenario.conditions, plan.scenario.environment.source.frequency, *mission.hearing);
  }
  host::leave_out_hydrophones(mission);
  return mission;
}

int fly_search(Options o, const std::optional<fly::OtherProcess>& owner, fly::FlightPage& page) {
  if (o.environment.empty()) o.environment = host::shipped("sim/ocean/environments/munk_flat.toml");
  if (o.mission.empty()) o.mission = host::shipped(default_mission(o));
  const host::MissionFile mission = checked_mission(o);
  warn_of_another_source(o, mission);
  if (mission.hearing && !o.hear && program::talk() != program::Talk::kQuiet)
    std::cerr
        << "earshot fly: the mission's hydrophone is left out: the simulator gives the SNR (--hear synthetic: the vehicle measures it)\n";
  const std::vector<host::BusLock> locks = lock_buses(o, mission);
  o.can_interface = chosen_can_interface(o, mission);
  FlightFolder folder(o.out);
  if (o.watch) page.begin(o.out);
  const link::RunSlot slot;
  Meeting meeting{.domain = slot.domain(),
                  .lcm_url = chosen_url(o, mission).value_or(slot.lcm_url()),
                  .hydrophone_url = slot.hydrophone_url(),
                  .folder = folder.unfinished(),
                  .board = std::nullopt};
  std::optional<fly::EmulatedBoard> board;
  if (o.board) {
    const fs::path program = fly::program_of_board(*o.board);
    meeting.board = board.emplace(program, meeting.run).line();
    if (program::talk() != program::Talk::kQuiet)
      std::cerr << "earshot fly: an emulated Cortex-M7 decides: " << host::printable(program.string()) << "\n";
  }
  ChildProcess runtime("earshotd", runtime_arguments(o, meeting));
  ChildProcess simulator("earshot-sim", simulator_arguments(o, meeting));
  wait_for_both(simulator, runtime, owner);
  runtime.report_signal("earshot fly");
  simulator.report_signal("earshot fly");
  const bool has_flown = fs::exists(folder.unfinished() / "summary.json");
  const int status = exit_status(simulator, runtime, has_flown);
  if (has_flown && conclude(o, folder, is_flown(simulator, runtime))) return status;
  if (stop_requested && !has_flown) std::cerr << "earshot fly: stopped before the flight began\n";
  if (fs::exists(folder.unfinished()))
    std::cerr << "earshot fly: this flight is not whole; " << fly::place_of_rest(folder.unfinished()) << "\n";
  return status == program::kDone ? program::kLost : status;
}

int fly_and_show(const Options& o) {
  program::stop_on_signals();
  const std::optional<fly::OtherProcess> owner =
      o.end_with ? std::make_optional<fly::OtherProcess>(static_cast<pid_t>(*o.end_with)) : std::nullopt;
  fly::FlightPage page;
  const int status = fly_search(o, owner, page);
  if (status == program::kDone) page.stay(owner);
  return status;
}

}  // namespace

int main(int argc, char** argv) {
  program::CommandLine line(
      "earshot fly",
      "earshot fly plays one search: an ocean with a sound source (earshot-sim) and the vehicle's own software (earshotd) in lock-step.\n"
      "Exit status: 0 flown (found or not), 2 bad input, 3 a process or a file was lost, 130 Ctrl-C.");
  Options options;
  declare(line, options);
  return program::run(line, argc, argv, [&] { return fly_and_show(options); });
}
