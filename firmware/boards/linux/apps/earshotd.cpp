// earshotd: the process that flies the vehicle.

#include <chrono>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <iostream>
#include <limits>
#include <memory>
#include <optional>
#include <string>

#include "firmware/boards/linux/bus_lock.hpp"
#include "firmware/boards/linux/host_clock.hpp"
#include "firmware/boards/linux/journal.hpp"
#include "firmware/boards/linux/mission_file.hpp"
#include "firmware/boards/linux/mission_loop.hpp"
#include "firmware/boards/linux/mission_turn.hpp"
#include "firmware/boards/linux/policy_file.hpp"
#include "firmware/boards/linux/vehicle_bus.hpp"
#include "firmware/boards/linux/waiting.hpp"
#include "firmware/config_file/table_reader.hpp"
#include "firmware/host/program/run.hpp"
#include "firmware/host/program/signals.hpp"
#include "firmware/runtime/runtime.hpp"
#include "sim/link/runtime_end.hpp"
#include "sim/link/session.hpp"

namespace {

using namespace earshot;

using program::kLost;
using program::stop_requested;

struct Options {
  std::filesystem::path mission;
  std::filesystem::path out = ".";
  std::optional<std::filesystem::path> policy;
  std::optional<std::filesystem::path> public_key;
  std::optional<std::uint64_t> seed;
  std::optional<std::string> bus;
  std::optional<std::string> lcm_url;
  std::optional<std::string> can_interface;
  std::optional<std::uint32_t> simulation;
  link::RunId run = 0;
  std::uint32_t wait_s = 60;
  bool replace = false;
};

void declare(program::CommandLine& line, Options& o) {
  line.option("MISSION", &o.mission, "mission file (TOML)").required();
  line.option("--out", &o.out, "folder for journal.lcmlog, made if it is missing").shows_default();
  line.flag("--replace", &o.replace,
            "replace a journal that is there already; without it: refuse to start in simulation, write journal-2.lcmlog and so on at sea");
  line.option("--policy", &o.policy, "policy file instead of the mission's");
  line.option("--public-key", &o.public_key, "file of the trusted public key instead of the mission's");
  line.option("--seed", &o.seed, "seed of a policy that draws its actions, instead of the mission's")
      .from(0, std::numeric_limits<std::int64_t>::max());
  line.option("--bus", &o.bus, "bus instead of the mission's").one_of({"lcm", "can"});
  line.option("--lcm-url", &o.lcm_url, "LCM address instead of the mission's");
  line.option("--can-interface", &o.can_interface, "CAN interface instead of the mission's");
  line.option("--simulation", &o.simulation,
              "fly in lock-step with a simulator in this DDS domain; without it: at sea, on this host's clock")
      .from(link::kLowestDomain, link::kHighestDomain);
  line.option("--run", &o.run, "in simulation: number of the run whose simulator is waited for; 0: of the first that knocks")
      .from(0, std::numeric_limits<std::int64_t>::max())
      .shows_default();
  line.option("--wait", &o.wait_s, "in simulation: how many seconds to wait for the simulator").from(1, 86'400).shows_default();
}

board::MissionFile load(const Options& o) {
  board::MissionFile file = board::load_mission(o.mission);
  if (o.policy) file.policy = *o.policy;
  if (o.public_key) file.public_key = *o.public_key;
  if (o.seed) file.mission.action_seed = *o.seed;
  if (o.bus) file.bus = *o.bus == "can" ? board::BusKind::kCan : board::BusKind::kLcm;
  if (o.lcm_url) file.lcm_url = *o.lcm_url;
  if (o.can_interface) file.can_interface = *o.can_interface;
  if (file.bus == board::BusKind::kCan && !o.simulation) {
    throw config_file::BadInput(o.mission.string() +
                                ": bus.kind = \"can\": carries no SNR estimate yet, so it must be \"lcm\" unless --simulation is given");
  }
  return file;
}

std::unique_ptr<runtime::Runtime> make_runtime(const board::MissionFile& file, const std::string& mission_name) {
  const std::unique_ptr<policy::FrozenPolicy> policy = board::load_policy(file.policy, file.public_key);
  board::check_fits(*policy, file.policy, file.mission, mission_name);
  auto runtime = std::make_unique<runtime::Runtime>();
  if (runtime->configure(file.mission, *policy) != Status::kOk)
    throw config_file::BadInput(mission_name + ": cannot be flown with the policy " + file.policy.string());
  return runtime;
}

board::JournalOptions journal_options(const Options& o) {
  using J = board::JournalOptions;
  return {.when_full = o.simulation ? J::WhenFull::kWait : J::WhenFull::kDrop,
          .survives = o.simulation ? J::Survives::kProcess : J::Survives::kPowerCut,
          .existing = o.replace ? J::Existing::kReplace : (o.simulation ? J::Existing::kRefuse : J::Existing::kKeep)};
}

/// Beside the journal, under its name: what was decided can be explained only with the policy that decided it. A disk that does not take it
/// is no reason to stay ashore.
void keep_policy(const std::filesystem::path& policy, const std::filesystem::path& journal) {
  const std::filesystem::path kept = std::filesystem::path(journal).replace_extension(".policy");
  std::error_code error;
  std::filesystem::copy_file(policy, kept, std::filesystem::copy_options::overwrite_existing, error);
  if (error) std::cerr << "earshotd: " << kept.string() << ": the policy cannot be kept there: " << error.message() << "\n";
}

/// Exit status: 0 for a mission flown to its end or stopped by a person, 3 when the other side was lost.
int report(const board::LoopResult& result, const board::VehicleBus& bus, const std::filesystem::path& journal) {
  const std::string after = " after " + std::to_string((result.time - result.began).us / 1'000'000) + " s";
  if (bus.counters().unsent_messages > 0)
    std::cerr << "earshotd: " << bus.counters().unsent_messages << " messages could not be put on the bus\n";
  const bool is_talkative = program::talk() != program::Talk::kQuiet;
  switch (result.end) {
    case board::LoopEnd::kMissionOver:
      if (is_talkative) std::cerr << "earshotd: " << board::in_words(result.last) << "; journal " << journal.string() << "\n";
      return 0;
    case board::LoopEnd::kStopped:
      if (is_talkative) std::cerr << "earshotd: stopped" << after << "; journal " << journal.string() << "\n";
      return 0;
    case board::LoopEnd::kSimulatorLost:
      std::cerr << "earshotd: lost the simulator" << after << "; journal up to then: " << journal.string() << "\n";
      return kLost;
    case board::LoopEnd::kBusLost:
      std::cerr << "earshotd: lost the bus" << after << ": navigation that the simulator sent did not arrive\n";
      return kLost;
  }
  return kLost;
}

/// @return exit status
template <class Loop>
int fly(const Options& o, const board::MissionFile& file, runtime::Runtime& runtime, board::VehicleBus& bus, Loop loop) {
  std::filesystem::create_directories(o.out);
  board::Journal journal(o.out / "journal.lcmlog", journal_options(o));
  keep_policy(file.policy, journal.path());
  board::MissionTurn turn(runtime, bus, journal);
  board::LoopResult result;
  try {
    result = loop(turn, journal.path());
  } catch (const std::exception& e) {  // no bad input: the journal has begun, and its destructor keeps it
    std::cerr << "earshotd: " << e.what() << "; journal up to then: " << journal.path().string() << "\n";
    return kLost;
  }
  const Status kept = journal.close();
  const int status = report(result, bus, journal.path());
  if (kept == Status::kOk && journal.counters().dropped == 0) return status;
  std::cerr << "earshotd: the journal is not whole: " << journal.counters().dropped << " records dropped, "
            << journal.counters().write_errors << " writes failed\n";
  return kLost;
}

/// The journal of an earlier flight is not touched before a simulator has come, and that comes when it has judged its own input.
int fly_in_simulation(const Options& o, const board::MissionFile& file, runtime::Runtime& runtime, board::VehicleBus& bus) {
  link::RuntimeEnd link(*o.simulation, o.run);
  const std::string whom = "a simulator in DDS domain " + std::to_string(*o.simulation);
  const board::Waited waited = board::wait_for("earshotd", whom, std::chrono::seconds(o.wait_s),
                                               [&](std::chrono::milliseconds most) { return link.wait_for_simulator(most); });
  if (waited != board::Waited::kCame) return waited == board::Waited::kStopped ? program::kStopped : kLost;
  const int status = fly(o, file, runtime, bus, [&](board::MissionTurn& turn, const std::filesystem::path&) {
    return board::fly_in_simulation(turn, bus, link, stop_requested);
  });
  if (link.strangers() > 0)
    std::cerr << "earshotd: " << link.strangers() << " ticks of another simulator in DDS domain " << *o.simulation << " were ignored\n";
  return status;
}

int fly_at_sea(const Options& o, const board::MissionFile& file, runtime::Runtime& runtime, board::VehicleBus& bus) {
  return fly(o, file, runtime, bus, [&](board::MissionTurn& turn, const std::filesystem::path& journal) {
    std::cerr << "earshotd: waiting on " << file.lcm_url << " for navigation, SNR and an operator's START, as long as it takes; journal "
              << journal.string() << "\n";
    const board::SeaTiming timing{
        .period = file.step_period, .navigation_timeout = file.mission.navigation_timeout, .snr_timeout = file.mission.snr_timeout};
    return board::fly_at_sea(turn, bus, board::HostClock(), timing, stop_requested);
  });
}

int fly(const Options& o) {
  const board::MissionFile file = load(o);
  const std::unique_ptr<runtime::Runtime> runtime = make_runtime(file, o.mission.string());
  // In simulation whoever started both processes holds it.
  const board::FileDescriptor lock = o.simulation ? board::FileDescriptor{} : board::lock_lcm(file.lcm_url);
  const std::unique_ptr<board::VehicleBus> bus = board::open_vehicle_bus(file);
  program::stop_on_signals();  // up to here nothing is under way that would have to end in order
  return o.simulation ? fly_in_simulation(o, file, *runtime, *bus) : fly_at_sea(o, file, *runtime, *bus);
}

}  // namespace

int main(int argc, char** argv) {
  program::CommandLine line("earshotd",
                            "earshotd flies one mission: navigation and SNR in, frozen policy, set-points out.\n"
                            "Exit status: 0 flown or stopped, 2 bad input, 3 the simulator, the bus or the journal was lost,\n"
                            "130 stopped before the simulator came.");
  Options options;
  declare(line, options);
  return program::run(line, argc, argv, [&] { return fly(options); });
}
