// Row replay.times_real_time: seconds of a mission per second of its replay, for a journal of a million turns of a search, one a second
// with a fix and an SNR, that the turns of earshotd wrote with the policy that ships. With the argument "peer": the same turns of the
// runtime alone.
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>

#include "firmware/boards/linux/mission_loop.hpp"
#include "firmware/boards/linux/mission_turn.hpp"
#include "firmware/boards/linux/port/port_set.hpp"
#include "firmware/boards/linux/replay/replay.hpp"
#include "firmware/host/journal/journal.hpp"
#include "firmware/host/mission/mission_file.hpp"
#include "firmware/host/mission/mission_verifier.hpp"
#include "tests/bench/short_form.hpp"
#include "tests/firmware/boards/linux/set_clock.hpp"
#include "tests/support/temporary_folder.hpp"

namespace {

using namespace earshot;
using Seconds = std::chrono::duration<double>;

const int kTurns = bench::full_or_short(1'000'000, 20'000);

struct Flown {
  host::MissionFile file = host::load_mission(std::filesystem::path(EARSHOT_SOURCE_DIR) / "firmware/boards/linux/missions/search.toml");
  host::SignedSearch search = host::MissionVerifier().load_search(file);
  std::unique_ptr<runtime::Runtime> runtime = std::make_unique<runtime::Runtime>();

  Flown() {
    file.mission.max_steps = kTurns;
    file.mission.max_time = Duration::seconds(10 * std::int64_t{kTurns});
    if (runtime->configure(file.mission, *search.policy.policy, *search.tables.tables) != Status::kOk)
      throw std::runtime_error("cannot be flown");
  }
};

/// A vehicle that does at once what it is told, and hears nothing of a source.
class Vehicle {
 public:
  template <class Take>
  void sail(Time now, const runtime::Outputs& outputs, const Take& take) {
    if (outputs.setpoint) setpoint_ = *outputs.setpoint;
    const double heading_rad = setpoint_.heading.value;
    place_ =
        place_ + NorthEast{Meters{setpoint_.speed.value * std::cos(heading_rad)}, Meters{setpoint_.speed.value * std::sin(heading_rad)}};
    take(messages::Navigation{
        .time = now, .position = place_, .depth = Meters{300}, .heading = setpoint_.heading, .speed = setpoint_.speed});
    take(messages::SnrMeasurement{.time = now, .snr = Decibels{3}});
    if (outputs.health.state == messages::MissionState::kStandby && !bench::is_wrong_on_purpose())
      take(messages::OperatorCommand{.time = now, .expiry = now, .issuer = 1, .number = ++orders_, .order = messages::Order::kStart});
  }

 private:
  NorthEast place_{Meters{12'500}, Meters{12'500}};
  messages::Setpoint setpoint_;
  std::uint32_t orders_ = 0;
};

constexpr Time kBegan{1'795'000'000'000'000};

Time at(int turn) {
  return kBegan + Duration::seconds(turn);
}

void write_journal(const std::filesystem::path& path) {
  Flown flown;
  board::SetClock clock;
  board::PortSet ports;
  host::Journal journal(path, {.when_full = host::JournalOptions::WhenFull::kWait});
  board::OwnCore core(*flown.runtime);
  board::MissionTurn turn(core, ports, journal, clock);
  turn.record_mission(flown.file.mission,
                      {.policy = flown.search.policy.bytes, .tables = flown.search.tables.bytes, .build = "a benchmark"});
  Vehicle vehicle;
  runtime::Outputs outputs;
  for (int i = 1; i <= kTurns; ++i) {
    clock.time = at(i);
    vehicle.sail(clock.time, outputs, [&turn](const auto& value) { turn.take(1, value); });
    outputs = turn();
  }
  journal.conclude(board::closing_record_of({.end = board::LoopEnd::kStopped, .last = outputs, .began = kBegan, .time = clock.time}));
  if (journal.close() != Status::kOk || outputs.health.state != messages::MissionState::kSearch)
    throw std::runtime_error("no search was flown");
}

double replay_times_real_time() {
  const support::TemporaryFolder folder;
  write_journal(folder / "journal.lcmlog");
  const auto began = std::chrono::steady_clock::now();
  const board::ReplayResult result = board::replay(folder / "journal.lcmlog");
  const Seconds took = std::chrono::steady_clock::now() - began;
  if (!result.is_same() || !result.closing || result.turns != static_cast<std::size_t>(kTurns))
    throw std::runtime_error("the journal is not replayed");
  constexpr std::size_t kMostTurnsPerDecision = 600;  // 1 km at 2 m/s takes 500, and the way to the first decision
  if (result.decisions < static_cast<std::size_t>(kTurns) / kMostTurnsPerDecision)
    throw std::runtime_error("too few decisions: " + std::to_string(result.decisions));
  return kTurns / took.count();
}

double runtime_times_real_time() {
  Flown flown;
  Vehicle vehicle;
  runtime::Outputs outputs;
  std::uint64_t sequence = 0;
  const auto began = std::chrono::steady_clock::now();
  for (int i = 1; i <= kTurns; ++i) {
    const Time now = at(i);
    vehicle.sail(now, outputs,
                 [&](const auto& value) { flown.runtime->take({.arrival = now, .port = 1, .sequence = sequence++, .value = value}); });
    outputs = flown.runtime->step(now);
  }
  const Seconds took = std::chrono::steady_clock::now() - began;
  if (outputs.health.state != messages::MissionState::kSearch) throw std::runtime_error("no search was flown");
  return kTurns / took.count();
}

}  // namespace

int main(int argc, char** argv) try {
  const bool is_peer = argc > 1 && std::string_view(argv[1]) == "peer";
  std::printf("{\"value\": %.0f}\n", is_peer ? runtime_times_real_time() : replay_times_real_time());
} catch (const std::exception& e) {
  std::fprintf(stderr, "%s\n", e.what());
  return 1;
}
