// How long after the newest fix on a CAN bus a set-point leaves earshotd, by the kernel's stamps, with or without others' load: p99 less
// the least of the run, in ms. Fixes come every 10 ms and turns every 100, so that the least is how old the newest fix happens to be when a
// turn is due, and says nothing. Run by hil/bus/with-can.
//   bench_can_latency [PGN]     8000 frames a second of that group, of another device

#include <sys/types.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "firmware/boards/linux/clock/host_clock.hpp"
#include "firmware/host/transport/can_socket.hpp"
#include "firmware/messages/dictionary/health_words.hpp"
#include "firmware/wire/n2k/fast_packet.hpp"
#include "firmware/wire/n2k/identifier.hpp"
#include "firmware/wire/n2k/own/measurements.hpp"
#include "firmware/wire/n2k/own/orders.hpp"
#include "firmware/wire/n2k/own/reports.hpp"
#include "firmware/wire/n2k/signals.hpp"
#include "firmware/wire/n2k/vehicle_state/navigation.hpp"
#include "tests/bench/short_form.hpp"
#include "tests/support/process.hpp"
#include "tests/support/temporary_folder.hpp"

namespace {

using namespace earshot;
using namespace std::chrono_literals;

constexpr const char* kInterface = "vcan0";
const auto kMeasured =
    bench::full_or_short(60s, 12s);  // in short, too, longer than a vehicle may stand still before a rule ends its search
constexpr std::uint8_t kEarshot = 0x40;
constexpr std::uint8_t kOther = 0x66;

/// 80 frames every 10 ms, until somebody ends it or the bus takes no more.
[[noreturn]] void load(std::uint32_t pgn) {
  host::CanSocket bus(kInterface);
  n2k::Frame frame{.identifier = n2k::compose({.pgn = pgn, .priority = 6, .source = kOther, .destination = n2k::kBroadcast}).value()};
  for (auto next = std::chrono::steady_clock::now();; std::this_thread::sleep_until(next)) {
    for (int i = 0; i < 80; ++i) {
      if (bus.send(frame) != Status::kOk) std::_Exit(1);
    }
    next += 10ms;
  }
}

std::filesystem::path write_mission(const std::filesystem::path& folder) {
  const std::filesystem::path source = EARSHOT_SOURCE_DIR;
  std::ifstream in(source / "firmware/boards/linux/missions/search_over_can_alone.toml");
  std::string text{std::istreambuf_iterator<char>(in), {}};
  const std::string_view period = "step_period_s = 1.0";
  text.replace(text.find(period), period.size(), "step_period_s = 0.1");
  std::ofstream(folder / "mission.toml") << text;
  return folder / "mission.toml";
}

/// The vehicle, its hydrophone and its operator. It goes north; wrong: it stands still, and a rule ends its search.
class Vehicle {
 public:
  /// Says what is due, ten milliseconds after the last time.
  void turn(bool has_started) {
    n2k::NavigationFrames frames;
    const messages::Navigation fix{
        .time = {},
        .position = {.north = Meters{12'500 + (bench::is_wrong_on_purpose() ? 0.0 : 0.02 * turns_)}, .east = Meters{12'500}},
        .depth = Meters{300},
        .heading = Radians{0},
        .speed = MetersPerSecond{2}};
    (void)n2k::compose_navigation(fix, plane_, n2k::kVehicleAddress, frames);
    if (turns_ % 10 == 0) {
      for (const n2k::Frame& frame : frames) (void)bus_.send(frame);
      n2k::Frame snr;
      (void)n2k::compose_snr({.snr = Decibels{3}, .too_faint = false, .band_level = {}}, n2k::kVehicleAddress, snr);
      (void)bus_.send(snr);
    } else {
      (void)bus_.send(frames[3]);
    }
    if (!has_started && turns_ % 100 == 99) start();
    ++turns_;
  }

 private:
  void start() {
    const Time now = clock_.utc();
    const messages::OperatorCommand command{
        .time = now, .expiry = now + Duration::seconds(20), .issuer = 4711, .number = ++orders_, .order = messages::Order::kStart};
    n2k::FastPacketFrames frames;
    (void)n2k::compose_command(command, {.source = n2k::kVehicleAddress, .destination = kEarshot, .sequence = 0}, frames);
    for (const n2k::Frame& frame : frames) (void)bus_.send(frame);
  }

  host::CanSocket bus_{kInterface};
  n2k::LocalPlane plane_ = n2k::LocalPlane::about({.latitude_deg = 38.5, .longitude_deg = -28.0}).value();
  board::HostClock clock_;
  std::uint32_t turns_ = 0;
  std::uint32_t orders_ = 0;
};

/// Stands by the bus with the kernel's stamps, and hears what the vehicle computer says of its state.
class SnrWindow {
 public:
  SnrWindow() : bus_(kInterface, host::IfMissing::kRefuse, options()) {}
  void listen() {
    std::size_t budget = config::kCanFramesPerCollect;
    Time arrival;
    for (n2k::Frame frame; bus_.receive(frame, arrival, budget) == Status::kOk;) {
      const n2k::Identifier identifier = n2k::parse_identifier(frame.identifier).value();
      const std::uint32_t pgn = identifier.pgn;
      constexpr unsigned kLastFrame = 3;  // of 21 bytes
      if (pgn == n2k::kPositionPgn) newest_fix_ = arrival;
      if (pgn == n2k::kHealthPgn) judge(identifier, frame);
      if (pgn == n2k::kHeadingControlPgn && (frame.data[0] & 0x1FU) == kLastFrame) latencies_us.push_back((arrival - newest_fix_).us);
    }
  }
  std::vector<std::int64_t> latencies_us;
  int healths_in_search = 0;

 private:
  /// @throws std::runtime_error: a search that was under way is so no more
  void judge(const n2k::Identifier& identifier, const n2k::Frame& frame) {
    std::span<const std::uint8_t> bytes;
    if (packets_.accept(identifier, frame, bytes) != Status::kOk) return;
    const messages::Health health = n2k::read_health(bytes).value().health;
    if (health.state == messages::MissionState::kSearch) {
      ++healths_in_search;
    } else if (healths_in_search > 0) {
      throw std::runtime_error(std::string("the search is over: state ") + to_string(health.state) + ", " + to_string(health.end_reason));
    }
  }
  static host::CanOptions options() {
    host::CanOptions options;
    (void)host::filters_for(std::vector{n2k::kPositionPgn, n2k::kHeadingControlPgn, n2k::kHealthPgn}, options.filters);
    return options;
  }
  host::CanSocket bus_;
  n2k::FastPacketAssembly packets_;
  Time newest_fix_;
};

std::vector<std::int64_t> measure() {
  Vehicle vehicle;
  SnrWindow snr_window;
  auto end = std::chrono::steady_clock::now() + kMeasured + 20s;
  for (auto next = std::chrono::steady_clock::now(); next < end; std::this_thread::sleep_until(next)) {
    vehicle.turn(!snr_window.latencies_us.empty());
    snr_window.listen();
    if (snr_window.latencies_us.size() == 1) end = next + kMeasured;
    next += 10ms;
  }
  if (snr_window.latencies_us.size() < 100 || snr_window.healths_in_search < 10) throw std::runtime_error("no search was flown");
  return snr_window.latencies_us;
}

double at_share(std::vector<std::int64_t>& sorted_us, double share) {
  return static_cast<double>(sorted_us[static_cast<std::size_t>(share * static_cast<double>(sorted_us.size() - 1))]) * 1e-3;
}

}  // namespace

int main(int argc, char** argv) try {
  const support::TemporaryFolder folder;
  const std::filesystem::path policy = std::filesystem::path(EARSHOT_SOURCE_DIR) / "policy/frozen";
  support::Process earshotd(std::filesystem::path(EARSHOT_BIN_DIR) / "earshotd",
                            {write_mission(folder.path()), "--can-interface", kInterface, "--out", folder.path(), "--policy",
                             policy / "shipped.policy", "--public-key", policy / "earshot.pub"},
                            folder / "earshotd.txt");
  const pid_t loader = argc > 1 ? ::fork() : -1;
  if (loader == 0) load(static_cast<std::uint32_t>(std::atol(argv[1])));
  std::vector<std::int64_t> latencies_us;
  std::string fault;
  try {
    latencies_us = measure();
    if (loader > 0 && ::waitpid(loader, nullptr, WNOHANG) != 0) fault = "the load broke off: the bus had no room for it";
  } catch (const std::exception& e) {
    fault = e.what();
  }
  if (loader > 0) {
    (void)::kill(loader, SIGKILL);
    (void)::waitpid(loader, nullptr, 0);
  }
  earshotd.signal(SIGTERM);
  (void)earshotd.wait(20s);
  if (!fault.empty()) throw std::runtime_error(earshotd.output() + fault);
  std::ranges::sort(latencies_us);
  std::cerr << latencies_us.size() << " set-points; ms after the newest fix: least " << at_share(latencies_us, 0.0) << ", median "
            << at_share(latencies_us, 0.5) << ", p99 " << at_share(latencies_us, 0.99) << ", at most " << at_share(latencies_us, 1.0)
            << "\n";
  std::cout << "{\"value\": " << at_share(latencies_us, 0.99) - at_share(latencies_us, 0.0) << "}\n";
} catch (const std::exception& e) {
  std::cerr << e.what() << "\n";
  return 1;
}
