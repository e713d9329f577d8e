// A mission of many days in one run, on a clock that does not wait: nothing may be allocated, no page be added, no counter begin anew.

#include <unistd.h>

#include <atomic>
#include <cstdio>
#include <memory>
#include <string>

#include "firmware/boards/linux/lcm_port.hpp"
#include "firmware/boards/linux/mission_loop.hpp"
#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/memory/heap_trap.hpp"
#include "firmware/host/mission/mission_file.hpp"
#include "firmware/host/mission/mission_verifier.hpp"
#include "firmware/host/program/run.hpp"
#include "tests/endurance/fast_sea.hpp"
#include "tests/endurance/witness.hpp"
#include "tests/support/private_network.hpp"

namespace earshot::endurance {
namespace {

constexpr int kNotHeld = 1;  ///< exit status: something of what is promised was not held

struct Options {
  double days = 30.0;
  std::string plant = "nothing";
};

Plant plant_of(const std::string& name) {
  if (name == "allocation") return Plant::kAllocation;
  if (name == "page") return Plant::kPage;
  return name == "wrap" ? Plant::kWrap : Plant::kNothing;
}

/// The search that ships, but for its end: as many steps and as much time as a mission file may have.
host::MissionFile endless_mission() {
  host::MissionFile file = host::load_mission(std::string(EARSHOT_SOURCE_DIR) + "/firmware/boards/linux/missions/search.toml");
  file.mission.max_steps = 1'000'000;
  file.mission.max_time = Duration::seconds(10'000'000);
  return file;
}

/// A third of an hour in STANDBY, a search for four fifths of the time, DONE, and ABORT for its last tenth.
Voyage voyage_of(double days, Duration period) {
  const auto share = [days](double part) { return Duration::seconds(static_cast<std::int64_t>(days * 86'400.0 * part)); };
  return {.period = period,
          .start = Duration::seconds(1200),
          .complete = share(0.8),
          .abort = share(0.9),
          .end = share(1.0),
          .between_orders = share(1.0 / 120.0)};
}

/// Says what was expected and what was found; remembers whether all was well.
class Verdict {
 public:
  void equal(const char* what, std::uint64_t expected, std::uint64_t found) {
    std::printf("  %-42s %14llu%s\n", what, static_cast<unsigned long long>(found), expected == found ? "" : "  WRONG");
    if (expected == found) return;
    std::printf("  %-42s %14llu\n", "  expected", static_cast<unsigned long long>(expected));
    is_held_ = false;
  }
  [[nodiscard]] bool is_held() const { return is_held_; }

 private:
  bool is_held_ = true;
};

/// What flew.
struct Flown {
  const FastSea& sea;
  const Witness& witness;
  const board::PortSet& ports;
  const host::Journal& journal;
  const board::LoopResult& result;
  host::ProcessMemory memory;
  bool is_locked;
};

bool is_held(const Flown& f) {
  Verdict verdict;
  const Witness::Seen& seen = f.witness.seen();
  const Sent& sent = f.sea.sent();
  const messages::Health& health = f.result.last.health;
  std::printf("%.2f days, %llu turns, %llu inputs, %llu set-points, %llu decisions, %llu records\n",
              static_cast<double>((f.result.time - f.result.began).us) / 86.4e9, static_cast<unsigned long long>(seen.turns),
              static_cast<unsigned long long>(sent.inputs), static_cast<unsigned long long>(seen.setpoints),
              static_cast<unsigned long long>(seen.decisions), static_cast<unsigned long long>(f.journal.counters().appended));
  verdict.equal("allocations: threads that made some", 0, host::heap_uses().size());
  for (const host::HeapUse& use : host::heap_uses()) std::printf("    %s\n", host::to_string(use).c_str());
  verdict.equal("own memory, bytes, as after the first hour", seen.first_hour.anonymous, f.memory.anonymous);
  if (f.is_locked) verdict.equal("resident, bytes, as after the first hour", seen.first_hour.resident, f.memory.resident);
  verdict.equal("turns after which a counter was lower", 0, seen.went_back);
  verdict.equal("decisions numbered otherwise than in order", 0, seen.misnumbered);
  verdict.equal("navigation refused", sent.refused.navigation_refused, health.counters.navigation_refused);
  verdict.equal("SNR refused", sent.refused.snr_refused, health.counters.snr_refused);
  verdict.equal("commands refused", sent.refused.commands_refused, health.counters.commands_refused);
  verdict.equal("commands acknowledged", sent.commands, seen.acknowledgements);
  verdict.equal("steps: decisions whose leg was sailed", seen.decisions, health.steps_taken);
  verdict.equal("state: ABORT after DONE", static_cast<std::uint64_t>(messages::MissionState::kAbort),
                static_cast<std::uint64_t>(health.state));
  verdict.equal("received by the first port, as it counts", f.sea.report().received, health.ports[0].received);
  verdict.equal("health heard on the bus", seen.turns, seen.heard);
  verdict.equal("nonsense on the bus, counted", seen.nonsense_sent, health.ports[1].malformed);
  verdict.equal("messages not sent", 0, f.ports.sum().unsent);
  verdict.equal("records lost", 0, f.journal.counters().all_lost());
  return verdict.is_held();
}

int run(const Options& options) {
  (void)test::enter_private_network();  // it would hear nobody else's missions; without the right to it, others' ports differ
  const host::MissionFile file = endless_mission();
  const host::SignedSearch search = host::MissionVerifier().load_search(file);
  auto runtime = std::make_unique<runtime::Runtime>();
  if (runtime->configure(file.mission, *search.policy.policy, *search.tables.tables) != Status::kOk)
    throw host::BadInput("the mission that ships cannot be flown for so long");

  FastHost host;
  FastClock clock(host);
  std::atomic<bool> stop{false};
  board::PortSet ports;
  const auto& [south_west, north_east] = file.mission.operating_area;
  const NorthEast middle{.north = 0.5 * (south_west.north + north_east.north), .east = 0.5 * (south_west.east + north_east.east)};
  auto sea_made = std::make_unique<FastSea>(ports.next_index(), voyage_of(options.days, file.step_period), middle, clock.now(), stop);
  const FastSea& sea = *sea_made;
  ports.add(std::move(sea_made));
  const std::string url = "udpm://239.255.76.67:" + std::to_string(20'000 + ::getpid() % 10'000) + "?ttl=0";
  ports.add(std::make_unique<board::LcmPort>(
      ports.next_index(), host::PortSettings{.name = "bus", .address = url, .roles = {host::Role::kNavigation, host::Role::kStatus}}));
  auto witness_made = std::make_unique<Witness>(ports.next_index(), url, file.step_period, plant_of(options.plant));
  const Witness& witness = *witness_made;
  ports.add(std::move(witness_made));

  // All the journal's work but for the disk's, which has no room for so many days.
  host::Journal journal("/dev/null", {.when_full = host::JournalOptions::WhenFull::kWait, .existing = host::ExistingJournal::kReplace});
  board::OwnCore core(*runtime);
  board::MissionTurn turn(core, ports, journal, clock);
  turn.record_mission(file.mission, {.policy = search.policy.bytes, .tables = search.tables.bytes, .build = "endurance"});
  host::touch_memory();
  const std::string unlocked = host::lock_memory();
  if (!unlocked.empty()) std::printf("%s\n", unlocked.c_str());

  host::arm_heap_trap();
  const board::LoopResult result = board::fly(turn, ports, clock, {.period = file.step_period}, stop);
  const host::ProcessMemory memory = host::process_memory();
  host::disarm_heap_trap();
  const bool held = is_held({.sea = sea,
                             .witness = witness,
                             .ports = ports,
                             .journal = journal,
                             .result = result,
                             .memory = memory,
                             .is_locked = unlocked.empty()});
  return held ? program::kDone : kNotHeld;
}

}  // namespace
}  // namespace earshot::endurance

int main(int argc, char** argv) {
  using namespace earshot;
  program::CommandLine line("long_mission",
                            "long_mission flies a mission of many days in one run, on a clock that does not wait.\n"
                            "Exit status: 0 nothing was allocated, no page added, no counter began anew; 1 otherwise.");
  endurance::Options options;
  line.option("--days", &options.days, "simulated days").between(0.2, 100.0).shows_default();
  line.option("--plant", &options.plant, "what is to be found out, done once an hour")
      .one_of({"nothing", "allocation", "page", "wrap"})
      .shows_default();
  return program::run(line, argc, argv, [&] { return endurance::run(options); });
}
