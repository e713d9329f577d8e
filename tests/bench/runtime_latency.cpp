// Rows runtime.latency_added_*_us: from a fix on the bus to the set-point that answers it, by earshotd in a search whose turns arrivals
// make, less the same by a bare echo: liblcm, which answers a fix with a message as long as a set-point. Both in this run, by turns, each
// in a process and on a group of its own; one fix at a time, so that what comes next answers it.
//   bench_runtime_latency p50|p999 [echo|resume]     echo: the time of the echo itself; resume: of an earshotd with --resume, as a service
//                                                    flies, whose set-point waits until what it answers is on the disk

#include <lcm/lcm.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <iterator>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "firmware/boards/linux/clock/host_clock.hpp"
#include "firmware/host/transport/lcm_endpoint.hpp"
#include "firmware/messages/dictionary/health_words.hpp"
#include "firmware/wire/lcm/channels.hpp"
#include "firmware/wire/lcm/encoding.hpp"
#include "tests/bench/short_form.hpp"
#include "tests/support/private_network.hpp"
#include "tests/support/process.hpp"
#include "tests/support/temporary_folder.hpp"

namespace {

using namespace earshot;
using namespace std::chrono_literals;
using steady_clock = std::chrono::steady_clock;

constexpr const char* kVehicleUrl = "udpm://239.255.76.67:7667?ttl=0";
constexpr const char* kEchoUrl = "udpm://239.255.76.68:7668?ttl=0";
const int kFixes =
    bench::full_or_short(20'000, 3'000);  // in short, too, longer than a vehicle may stand still before a rule ends its search
constexpr auto kBetweenFixes = 3ms;       ///< longer than between two turns at least
constexpr int kFixesPerMeasurement = 300;

/// Answers every fix, until somebody ends it.
[[noreturn]] void echo() {
  lcm_t* const bus = lcm_create(kEchoUrl);
  if (bus == nullptr) std::_Exit(1);
  const auto answer = [](const lcm_recv_buf_t* /*fix*/, const char* /*channel*/, void* user) {
    const wire::Encoded setpoint(messages::Setpoint{}, Time{});
    const auto bytes = setpoint.bytes();
    (void)lcm_publish(static_cast<lcm_t*>(user), wire::kSetpointChannel.data(), bytes.data(), static_cast<unsigned>(bytes.size()));
  };
  lcm_subscribe(bus, wire::kNavStateChannel.data(), answer, bus);
  while (lcm_handle(bus) == 0) {
  }
  std::_Exit(1);
}

/// The vehicle's side of a bus, who sends fixes and waits for what answers them. It goes north; wrong: it stands still, and a rule ends its
/// search.
class Vehicle {
 public:
  explicit Vehicle(const char* url) : bus_(host::parse_lcm_url(url), {wire::kSetpointChannel, wire::kHealthChannel}) {}

  /// @return microseconds until the set-point; nothing: none within a tenth of a second
  std::optional<double> ask() {
    constexpr int kPatience_ms = 100;
    while (take()) {
    }
    const Time now = clock_.utc();
    const wire::Encoded fix(messages::Navigation{
        .time = now,
        .position = {.north = Meters{12'500 + (bench::is_wrong_on_purpose() ? 0.0 : 2.0) * (now - began_).to_seconds()},
                     .east = Meters{12'500}},
        .depth = Meters{300},
        .heading = Radians{0},
        .speed = MetersPerSecond{2}});
    const auto sent = steady_clock::now();
    (void)bus_.publish(wire::kNavStateChannel, fix.bytes());
    while (!take()) {
      pollfd readable{.fd = bus_.file_descriptor(), .events = POLLIN, .revents = 0};
      if (steady_clock::now() - sent > 100ms || ::poll(&readable, 1, kPatience_ms) <= 0) return std::nullopt;
    }
    return std::chrono::duration<double, std::micro>(steady_clock::now() - sent).count();
  }
  void measurement() {
    (void)bus_.publish(wire::kSnrEstimateChannel,
                       wire::Encoded(messages::SnrMeasurement{.time = clock_.utc(), .snr = Decibels{3}}).bytes());
  }
  [[nodiscard]] int healths_in_search() const { return healths_in_search_; }
  void start() {
    const Time now = clock_.utc();
    const messages::OperatorCommand command{
        .time = now, .expiry = now + Duration::seconds(20), .issuer = 4711, .number = ++orders_, .order = messages::Order::kStart};
    (void)bus_.publish(wire::kOperatorCommandChannel, wire::Encoded(command).bytes());
  }

 private:
  bool take() {
    if (take_of_those_here()) return true;
    bus_.collect();
    return take_of_those_here();
  }
  /// A set-point; of what else is there the state is judged.
  bool take_of_those_here() {
    for (wire::Lc02Message message; bus_.take(message) == Status::kOk;) {
      if (message.channel == wire::kSetpointChannel) return true;
      judge(message.data);
    }
    return false;
  }
  /// @throws std::runtime_error: a search that was under way is so no more
  void judge(std::span<const std::uint8_t> bytes) {
    messages::Health health;
    if (wire::decode(bytes, health) != Status::kOk) throw std::runtime_error("earshotd's health cannot be read");
    if (health.state == messages::MissionState::kSearch) {
      ++healths_in_search_;
    } else if (healths_in_search_ > 0) {
      throw std::runtime_error(std::string("the search is over: state ") + to_string(health.state) + ", " + to_string(health.end_reason));
    }
  }

  host::LcmEndpoint bus_;
  board::HostClock clock_;
  Time began_ = clock_.utc();
  int healths_in_search_ = 0;
  std::uint32_t orders_ = 0;
};

struct Latencies {
  std::vector<double> earshotd_us;
  std::vector<double> echo_us;
  int unanswered = 0;
};

void begin_search(Vehicle& vehicle) {
  for (int i = 0; i < 100; ++i) {
    vehicle.measurement();
    if (vehicle.ask()) return;
    if (i % 10 == 9) vehicle.start();
  }
  throw std::runtime_error("no search was begun");
}

Latencies measure() {
  Vehicle vehicle(kVehicleUrl);
  Vehicle asker(kEchoUrl);
  begin_search(vehicle);
  Latencies latencies;
  for (int i = 0; i < kFixes; ++i) {
    const auto began = steady_clock::now();
    // Who is asked after the pause finds the processor asleep: each is, every other time.
    const bool is_echo_first = i % 2 == 1;
    std::optional<double> echoed = is_echo_first ? asker.ask() : std::nullopt;
    const std::optional<double> answered = vehicle.ask();
    if (!is_echo_first) echoed = asker.ask();
    if (answered) latencies.earshotd_us.push_back(*answered);
    if (echoed) latencies.echo_us.push_back(*echoed);
    if (!answered || !echoed) ++latencies.unanswered;
    if (i % kFixesPerMeasurement == 0) vehicle.measurement();
    std::this_thread::sleep_until(began + kBetweenFixes);
  }
  if (2 * vehicle.healths_in_search() < kFixes) throw std::runtime_error("most turns were no search's");
  return latencies;
}

double at_share(std::vector<double>& values, double share) {
  if (2 * values.size() < static_cast<std::size_t>(kFixes)) throw std::runtime_error("half of the fixes were not answered");
  std::ranges::sort(values);
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

std::filesystem::path write_mission(const std::filesystem::path& folder) {
  std::ifstream in(std::filesystem::path(EARSHOT_SOURCE_DIR) / "firmware/boards/linux/missions/search.toml");
  std::ofstream(folder / "mission.toml") << "turns = \"on_arrival\"\n" << std::string{std::istreambuf_iterator<char>(in), {}};
  return folder / "mission.toml";
}

}  // namespace

int main(int argc, char** argv) try {
  const std::string_view figure = argc > 1 ? argv[1] : "p50";
  const std::string_view of = argc > 2 ? argv[2] : "";
  const bool is_echo = of == "echo";
  if (!test::enter_private_network()) throw std::runtime_error(test::kNoPrivateNetwork);
  const pid_t echoing = ::fork();
  if (echoing == 0) echo();
  const support::TemporaryFolder folder;
  const std::filesystem::path policy = std::filesystem::path(EARSHOT_SOURCE_DIR) / "policy/frozen";
  std::vector<std::string> arguments{
      write_mission(folder.path()), "--lcm-url",    kVehicleUrl,           "--out", folder.path(), "--policy",
      policy / "shipped.policy",    "--public-key", policy / "earshot.pub"};
  if (of == "resume") arguments.emplace_back("--resume");
  support::Process earshotd(std::filesystem::path(EARSHOT_BIN_DIR) / "earshotd", arguments, folder / "earshotd.txt");
  Latencies latencies;
  try {
    latencies = measure();
  } catch (const std::exception&) {
    std::cerr << earshotd.output();
    (void)::kill(echoing, SIGKILL);
    throw;
  }
  earshotd.signal(SIGTERM);
  (void)earshotd.wait(20s);
  (void)::kill(echoing, SIGKILL);
  (void)::waitpid(echoing, nullptr, 0);
  for (const double share : {0.0, 0.5, 0.99, 0.999, 1.0})
    std::cerr << "share " << share << ": earshotd " << at_share(latencies.earshotd_us, share) << " us, echo "
              << at_share(latencies.echo_us, share) << " us\n";
  std::cerr << latencies.unanswered << " fixes without an answer\n";
  const double share = figure == "p999" ? 0.999 : 0.5;
  const double of_echo = at_share(latencies.echo_us, share);
  std::cout << "{\"value\": " << (is_echo ? of_echo : at_share(latencies.earshotd_us, share) - of_echo) << "}\n";
} catch (const std::exception& e) {
  std::cerr << e.what() << "\n";
  return 1;
}
