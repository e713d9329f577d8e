// earshot-fly: one search from start to report: earshot-sim, earshotd, what happened.

#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>
#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "firmware/boards/linux/bus_lock.hpp"
#include "firmware/boards/linux/lcm_url.hpp"
#include "firmware/boards/linux/mission_file.hpp"
#include "firmware/host/program/run.hpp"
#include "firmware/host/program/signals.hpp"
#include "sim/apps/flight_plan.hpp"
#include "sim/apps/flight_record.hpp"
#include "sim/apps/speed_option.hpp"
#include "sim/link/run_slot.hpp"

namespace {

using namespace earshot;
namespace fs = std::filesystem;

using program::stop_requested;

struct Options {
  fs::path environment;
  fs::path mission;
  fs::path out = "out";
  std::uint64_t seed = 1;
  std::string speed = "0";
  std::optional<fs::path> policy;
  std::optional<fs::path> public_key;
  std::optional<std::string> bus;
  std::optional<std::string> lcm_url;
  std::optional<std::string> can_interface;
  bool ignore_source = false;
  bool no_report = false;
};

void declare(program::CommandLine& line, Options& o) {
  line.option("--environment", &o.environment, "ocean, source and noise (TOML)").required();
  line.option("--mission", &o.mission, "area, depth, speed, limits, bus, policy (TOML)").required();
  line.option("--out", &o.out, "folder for journal.lcmlog, track.csv, snr.csv, summary.json and report.html").shows_default();
  line.option("--seed", &o.seed, "where the vehicle starts, and how a policy that draws its actions draws them")
      .from(0, std::numeric_limits<std::int64_t>::max())
      .shows_default();
  line.option("--speed", &o.speed, "simulated seconds per second; 0: as fast as it goes")
      .checked(simulation::speed_complaint, simulation::kSpeedsAllowed)
      .shows_default();
  line.option("--policy", &o.policy, "policy file instead of the mission's");
  line.option("--public-key", &o.public_key, "file of the public key that signed it, instead of the mission's");
  line.option("--bus", &o.bus, "bus between autopilot and earshotd instead of the mission's").one_of({"lcm", "can"});
  line.option("--lcm-url", &o.lcm_url, "LCM address; default: one that no other flight on this machine uses");
  line.option("--can-interface", &o.can_interface, "CAN interface instead of the mission's; vcan0 stands in for can0, the bus at sea");
  line.flag("--ignore-source", &o.ignore_source, "fly on to the last step even when the source is reached (benchmarks)");
  line.flag("--no-report", &o.no_report, "do not write report.html");
}

/// Where the two processes of a flight find each other.
struct Meeting {
  std::uint32_t domain = 0;
  std::string lcm_url;
  link::RunId run = link::new_run();
};

template <class Value>
void add(std::vector<std::string>& arguments, const char* name, const std::optional<Value>& value) {
  if (value) arguments.insert(arguments.end(), {name, std::string(*value)});
}

std::vector<std::string> common_arguments(const Options& o, const Meeting& meeting) {
  std::vector<std::string> a{"--out",     o.out.string(),  "--seed", std::to_string(o.seed),
                             "--lcm-url", meeting.lcm_url, "--run",  std::to_string(meeting.run)};
  add(a, "--bus", o.bus);
  add(a, "--can-interface", o.can_interface);
  return a;
}

std::vector<std::string> simulator_arguments(const Options& o, const Meeting& meeting) {
  std::vector<std::string> a = common_arguments(o, meeting);
  a.insert(a.end(), {"--environment", o.environment.string(), "--mission", o.mission.string(), "--domain", std::to_string(meeting.domain),
                     "--speed", o.speed});
  if (o.ignore_source) a.emplace_back("--ignore-source");
  return a;
}

std::vector<std::string> runtime_arguments(const Options& o, const Meeting& meeting) {
  constexpr const char* kWait_s = "86400";  // this program looks after both
  std::vector<std::string> a = common_arguments(o, meeting);
  a.insert(a.end(), {o.mission.string(), "--replace", "--simulation", std::to_string(meeting.domain), "--wait", kWait_s});
  add(a, "--policy", o.policy);
  add(a, "--public-key", o.public_key);
  return a;
}

fs::path own_folder() {
  return fs::read_symlink("/proc/self/exe").parent_path();
}

/// Starts a program that stands beside this one, in a process group of its own (a terminal's Ctrl-C then reaches only this program, which
/// ends both in order) and to be ended with this process.
pid_t start(const std::string& program, const std::vector<std::string>& arguments) {
  const std::string path = own_folder() / program;
  std::vector<char*> argv{const_cast<char*>(path.c_str())};
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error(std::string("cannot start another process: ") + std::strerror(errno));
  if (child > 0) return child;
  (void)setpgid(0, 0);
  (void)prctl(PR_SET_PDEATHSIG, SIGTERM);
  (void)execv(path.c_str(), argv.data());
  (void)std::fprintf(stderr, "%s: %s\n", path.c_str(), std::strerror(errno));
  _exit(2);
}

/// One of the two processes of a flight.
struct Process {
  pid_t id = 0;
  int status = -1;  ///< exit status, 128 + signal; -1 while it runs

  [[nodiscard]] bool running() const { return status < 0; }
  void poll() {
    int raw = 0;
    if (running() && waitpid(id, &raw, WNOHANG) == id) status = WIFEXITED(raw) ? WEXITSTATUS(raw) : 128 + WTERMSIG(raw);
  }
  void signal(int number) const {
    if (running()) (void)kill(id, number);
  }
};

/// One of them refused its input, or the simulator was stopped before the first tick.
bool never_begins(const Process& simulator, const Process& runtime) {
  return simulator.status == 2 || runtime.status == 2 || simulator.status == 130;
}

/// Waits for both. Ctrl-C goes to the simulator, which tells earshotd to abort; whoever has not left some seconds after the other is ended.
void wait_for_both(Process& simulator, Process& runtime) {
  using std::chrono::steady_clock;
  constexpr auto kGrace = std::chrono::seconds(6);  // longer than either takes to notice by itself that the other is gone
  std::optional<steady_clock::time_point> deadline;
  bool stopping = false;
  while (simulator.running() || runtime.running()) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    simulator.poll();
    runtime.poll();
    if (stop_requested && !stopping) {
      stopping = true;
      simulator.signal(SIGINT);
    }
    if (never_begins(simulator, runtime)) {  // the other waits in vain
      simulator.signal(SIGTERM);
      runtime.signal(SIGTERM);
    }
    if (!deadline && (stopping || !simulator.running() || !runtime.running())) deadline = steady_clock::now() + kGrace;
    if (deadline && steady_clock::now() > *deadline) {
      simulator.signal(SIGKILL);
      runtime.signal(SIGKILL);
    }
  }
}

std::string duration(double s) {
  const auto minutes = static_cast<long>(s / 60.0);
  std::array<char, 64> text{};
  (void)std::snprintf(text.data(), text.size(), "%ld h %02ld min", minutes / 60, minutes % 60);
  return text.data();
}

void print_summary(const fs::path& out) {
  std::ifstream stream(out / "summary.json");
  if (!stream) return;
  const nlohmann::json s = nlohmann::json::parse(stream);
  const double sim_time_s = s.at("sim_time_s");
  const double wall_time_s = s.at("wall_time_s");
  std::printf("%s\n", s.at("found").get<bool>() ? "source found" : ("source not found: " + s.at("end_reason").get<std::string>()).c_str());
  const bool is_last_cut = s.at("whole_steps") < s.at("steps");
  std::printf("  reward      %.1f\n  steps       %d%s\n  detections  %d\n  distance    %.1f km\n", s.at("reward").get<double>(),
              s.at("steps").get<int>(), is_last_cut ? ", the last one cut short by the source" : "", s.at("detections").get<int>(),
              s.at("distance_m").get<double>() / 1e3);
  std::printf("  time        %s at sea in %.2f s: %.0f times real time\n", duration(sim_time_s).c_str(), wall_time_s,
              sim_time_s / std::max(wall_time_s, 1e-9));
}

int run(const std::string& program, const std::vector<std::string>& arguments) {
  Process process{.id = start(program, arguments)};
  while (process.running()) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    process.poll();
  }
  return process.status;
}

/// The simulator keeps what it has once the flight has begun.
bool has_flown(const Process& simulator) {
  return simulator.status == 0 || simulator.status == 3;
}

/// A process that we ended because the other refused its input has a status of its own; the refusal is what counts.
int exit_status(const Process& simulator, const Process& runtime) {
  if (stop_requested) return program::kStopped;
  if (!has_flown(simulator) && (simulator.status == 2 || runtime.status == 2)) return 2;
  return simulator.status == 0 && runtime.status == 0 ? 0 : 3;
}

/// The LCM address that somebody chose; what a mission at sea uses when nobody did is never a simulation's.
std::optional<std::string> chosen_url(const Options& o, const board::MissionFile& mission) {
  if (o.lcm_url) return o.lcm_url;
  return mission.lcm_url == board::kDefaultLcmUrl ? std::nullopt : std::optional(mission.lcm_url);
}

/// A simulation puts no frames on the bus that a vehicle has at sea unless somebody says so.
std::string chosen_can_interface(const Options& o, const board::MissionFile& mission) {
  if (o.can_interface) return *o.can_interface;
  return mission.can_interface == board::kDefaultCanInterface ? "vcan0" : mission.can_interface;
}

/// Holds a bus that somebody chose; a run slot holds its own.
board::FileDescriptor lock_bus(const Options& o, const board::MissionFile& mission) {
  const bool over_can = o.bus ? *o.bus == "can" : mission.bus == board::BusKind::kCan;
  if (over_can) return board::lock_can(chosen_can_interface(o, mission));
  const std::optional<std::string> url = chosen_url(o, mission);
  return url ? board::lock_lcm(*url) : board::FileDescriptor{};
}

int fly(Options o) {
  program::stop_on_signals();
  // Both processes would say the same about a bad file: say it once, before either starts.
  const board::MissionFile mission = simulation::load_flight_plan(o.mission, o.environment).mission;
  const board::FileDescriptor lock = lock_bus(o, mission);
  o.can_interface = chosen_can_interface(o, mission);
  const link::RunSlot slot;
  const Meeting meeting{.domain = slot.domain(), .lcm_url = chosen_url(o, mission).value_or(slot.lcm_url())};
  Process runtime{.id = start("earshotd", runtime_arguments(o, meeting))};
  Process simulator{.id = start("earshot-sim", simulator_arguments(o, meeting))};
  wait_for_both(simulator, runtime);

  if (!has_flown(simulator)) {
    // An earshotd that took its input has begun a journal; what stands beside it is of an earlier flight. Otherwise all of that is whole.
    if (runtime.status != 2) simulation::remove_results(o.out);
    return exit_status(simulator, runtime);
  }
  print_summary(o.out);
  if (!o.no_report && fs::exists(o.out / "summary.json") && run("earshot-report", {o.out.string()}) == 0) {
    std::printf("  report      %s\n", (o.out / "report.html").c_str());
  }
  return exit_status(simulator, runtime);
}

}  // namespace

int main(int argc, char** argv) {
  program::CommandLine line(
      "earshot fly",
      "earshot fly plays one search: an ocean with a sound source (earshot-sim) and the vehicle's own software (earshotd) in lock-step.\n"
      "Exit status: 0 flown (found or not), 2 bad input, 3 a process was lost, 130 Ctrl-C.");
  Options options;
  declare(line, options);
  return program::run(line, argc, argv, [&] { return fly(options); });
}
