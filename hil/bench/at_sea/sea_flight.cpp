#include "hil/bench/at_sea/sea_flight.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include "firmware/host/program/exit_status.hpp"
#include "firmware/host/text/numbers.hpp"
#include "hil/bench/at_sea/bus_reader.hpp"
#include "hil/bench/at_sea/sea_computer.hpp"
#include "hil/bench/at_sea/sea_equipment.hpp"
#include "hil/bench/at_sea/sea_program.hpp"
#include "hil/bench/verdict.hpp"
#include "hil/bus/interface_switch.hpp"
#include "hil/nodes/scaled_clock.hpp"
#include "hil/nodes/vehicle/track_file.hpp"

namespace earshot::hil {
namespace {

using program::ChildProcess;
using program::ChildSettings;

// By the host's clock.
constexpr std::chrono::milliseconds kPollInterval{5};
constexpr Duration kToBegin = Duration::seconds(60);  ///< until the search has begun, on a busy machine
constexpr Duration kToEnd = Duration::seconds(20);    ///< until a program that was told to end has ended

std::string written(double number) {
  return host::decimals(number, 6);
}

std::string written(NorthEast place) {
  return written(place.north.value) + "," + written(place.east.value);
}

/// A fault of the case, as far as it has come.
struct InjectedFault {
  const TimedFault& fault;
  bool has_begun = false;
  bool has_ended = false;
};

std::vector<InjectedFault> all_of(const Case& c) {
  std::vector<InjectedFault> all;
  for (const TimedFault& fault : c.faults) all.push_back({.fault = fault});
  return all;
}

/// Whether Earshot could not say on the bus how its search ended.
bool is_beyond_hearing(const TimedFault& fault) {
  return fault.fault == Fault::kBusOff || (fault.fault == Fault::kNetem && fault.how.find("loss 100%") != std::string::npos);
}

/// One flight in the making.
class SeaFlyer {
 public:
  SeaFlyer(const Case& c, const Bench& bench, const std::filesystem::path& folder)
      : case_(c),
        bench_(bench),
        equipment_(c, bench),
        bus_(bench.interface),
        earshotd_("earshotd", [this] { return start_earshotd(); }),
        vehicle_("the vehicle's program", [this] { return start_vehicle(); }),
        faults_(all_of(c)),
        computer_(c, bench.interface, folder) {
    flight_.folder = folder;
  }

  BenchFlight fly() {
    if (case_.expected.refuses_to_fly) inject(Time{});
    earshotd_.start();
    vehicle_.start();
    if (begin()) sail();
    flight_.last = now();
    end();
    flight_.wall_s = (ScaledClock::host_now() - launched_).to_seconds();
    bus_.report(flight_);
    take_track();
    return std::move(flight_);
  }

 private:
  // The two programs.

  [[nodiscard]] std::unique_ptr<ChildProcess> start_earshotd() const {
    ChildSettings settings{.words = words()};
    computer_.set_up(settings);
    // As a service has it.
    std::filesystem::create_directory(memory());
    settings.environment.push_back("RUNTIME_DIRECTORY=" + memory().string());
    // As a vehicle's computer has it started every time.
    std::vector<std::string> a{is_gone(kMissionFile) ? none() : case_.mission.string(),
                               "--speed",
                               written(*case_.speed),
                               "--quiet",
                               "--resume",
                               "--out",
                               flight_.folder};
    const auto add = [&a](const std::vector<std::string>& more) { a.insert(a.end(), more.begin(), more.end()); };
    if (earshotd_.exit_statuses().empty()) add({"--speed-since", written((launched_utc_ - Time{}).to_seconds())});
    if (is_gone(kPolicyFile)) add({"--policy", none()});
    if (is_gone(kTablesFile)) add({"--tables", none()});
    add(equipment_.options_of_earshotd());
    return std::make_unique<ChildProcess>(bench_.earshotd, a, settings);
  }

  [[nodiscard]] bool is_gone(std::string_view file) const { return computer_.is_gone(file, now()); }
  /// Where there is no file.
  [[nodiscard]] std::string none() const { return flight_.folder / "none"; }

  [[nodiscard]] std::filesystem::path memory() const { return flight_.folder / kMemory; }

  /// Where it was when its program ended.
  [[nodiscard]] std::unique_ptr<ChildProcess> start_vehicle() const {
    const std::vector<TrackPlace> sailed = read_track(track_file());
    const NorthEast start = sailed.empty() ? case_.start : sailed.back().position;
    const std::vector<std::string> a{"--mission", case_.mission,         "--interface",   bench_.interface,
                                     "--speed",   written(*case_.speed), "--start",       written(start),
                                     "--source",  written(case_.source), "--seed",        std::to_string(bench_.seed),
                                     "--track",   track_file(),          "--environment", bench_.environment};
    return std::make_unique<ChildProcess>("earshot-emulate", a, ChildSettings{.words = vehicle_words()});
  }

  [[nodiscard]] std::filesystem::path track_file() const { return flight_.folder / "track.csv"; }
  [[nodiscard]] std::filesystem::path words() const { return flight_.folder / "words.txt"; }
  [[nodiscard]] std::filesystem::path vehicle_words() const { return flight_.folder / "vehicle.txt"; }

  /// Whom a fault hits.
  [[nodiscard]] SeaProgram& program_of(const TimedFault& fault) { return fault.device == kVehiclesProgram ? vehicle_ : earshotd_; }

  // The flight.

  /// @return whether the search has begun
  [[nodiscard]] bool begin() {
    while (!is_in(messages::MissionState::kSearch)) {
      if (bench_.stop || has_refused() || is_anybody_lost()) return false;
      if (ScaledClock::host_now() - launched_ > kToBegin) return fail_false("the search did not begin within a minute");
      turn();
    }
    bus_.forget();
    began_ = ScaledClock::host_now();
    flight_.began = launched_utc_ + at_sea(began_ - launched_);
    return true;
  }

  [[nodiscard]] bool has_refused() { return case_.expected.refuses_to_fly && earshotd_.is_lost(); }

  void sail() {
    while (!is_over() && !bench_.stop && now() - Time{} < case_.at_most && !is_anybody_lost()) {
      inject(now());
      turn();
    }
    if (is_over() && !std::ranges::all_of(faults_, &InjectedFault::has_begun)) fail("the search was over before all faults had begun");
  }

  void turn() {
    std::this_thread::sleep_for(kPollInterval);
    bus_.hear(now());
  }

  [[nodiscard]] Duration at_sea(Duration on_host) const { return Duration{std::llround(static_cast<double>(on_host.us) * *case_.speed)}; }
  [[nodiscard]] Time now() const { return Time{} + at_sea(ScaledClock::host_now() - began_); }

  [[nodiscard]] bool is_in(messages::MissionState state) const { return bus_.health() && bus_.health()->state == state; }
  [[nodiscard]] bool is_over() {
    if (is_in(messages::MissionState::kDone) || is_in(messages::MissionState::kAbort)) return !case_.expected.comes_up || is_up();
    const bool comes_back = std::ranges::any_of(faults_, [this](const InjectedFault& b) {
      return b.fault.fault == Fault::kKill && &program_of(b.fault) == &earshotd_ && b.has_begun && b.fault.until && !b.has_ended;
    });
    return !comes_back && !earshotd_.runs() && !earshotd_.is_lost();
  }

  /// By its track, which is read once a second.
  [[nodiscard]] bool is_up() {
    const Time host = ScaledClock::host_now();
    if (host - polled_ < Duration::seconds(1)) return is_up_;
    polled_ = host;
    const std::vector<TrackPlace> sailed = read_track(track_file());
    is_up_ = !sailed.empty() && sailed.back().depth <= kAtSurface;
    return is_up_;
  }

  [[nodiscard]] bool is_anybody_lost() {
    for (SeaProgram* program : {&earshotd_, &vehicle_}) {
      if (program->is_lost()) fail(ended(*program, program->exit_statuses().back()));
    }
    return !flight_.failure.empty();
  }

  /// In words; what earshotd said is told with its exit statuses.
  [[nodiscard]] std::string ended(const SeaProgram& which, int status) const {
    const std::string last_words_ = &which == &vehicle_ ? program::last_words(vehicle_words()) : "";
    return which.name() + " ended with status " + std::to_string(status) + (last_words_.empty() ? "" : ": " + last_words_);
  }

  // Faults.

  void inject(Time now) {
    for (InjectedFault& one : faults_) {
      if (!one.has_begun && now >= one.fault.from) {
        one.has_begun = true;
        begin(one.fault);
      }
      if (one.has_begun && !one.has_ended && one.fault.until && now >= *one.fault.until) {
        one.has_ended = true;
        end(one.fault);
      }
    }
  }

  void begin(const TimedFault& fault) {
    switch (fault.fault) {
      case Fault::kKill:
        return program_of(fault).kill();
      case Fault::kPause:
        return program_of(fault).halt();
      case Fault::kStop:
        return program_of(fault).stop();
      case Fault::kInterfaceDown:
        return switch_bus(false);
      default:
        return is_of_computer(fault) ? computer_.begin(fault) : equipment_.begin(fault);
    }
  }

  void end(const TimedFault& fault) {
    switch (fault.fault) {
      case Fault::kKill:
        return program_of(fault).start();
      case Fault::kPause:
        return program_of(fault).go_on();
      case Fault::kInterfaceDown:
        return switch_bus(true);
      case Fault::kStop:
        return;  // it stays stopped
      default:
        return is_of_computer(fault) ? computer_.end(fault) : equipment_.end(fault);
    }
  }

  [[nodiscard]] static bool is_of_computer(const TimedFault& fault) { return fault.traits().hits == FaultTarget::kComputer; }

  void switch_bus(bool is_up) {
    is_interface_up_ = is_up;
    switch_interface(bench_.interface, is_up);
    if (is_up) bus_.come_back();
  }

  // The end.

  /// Earshot first: the vehicle hears to the last what it says.
  void end() {
    flight_.end = bus_.health() ? bus_.health()->end_reason : messages::EndReason::kNone;
    end(earshotd_);
    flight_.exit_statuses = earshotd_.exit_statuses();
    flight_.last_words = program::last_words(words());
    flight_.is_end_heard =
        std::ranges::none_of(faults_, [](const InjectedFault& b) { return is_beyond_hearing(b.fault) && b.has_begun && !b.has_ended; });
    flight_.uncounted = equipment_.uncounted();
    end(vehicle_);
    if (!is_interface_up_) switch_bus(true);
    computer_.widen_queue();
    flight_.refused = computer_.refused();
    for (const int status : vehicle_.exit_statuses()) {
      const bool is_killed = status == 128 + SIGKILL && std::ranges::any_of(faults_, [this](const InjectedFault& b) {
                               return b.fault.fault == Fault::kKill && &program_of(b.fault) == &vehicle_;
                             });
      const bool is_stopped_early = status == 128 + SIGTERM;  // before it was ready to end in order
      if (status != program::kDone && !is_killed && !is_stopped_early) fail(ended(vehicle_, status));
    }
  }

  void end(SeaProgram& program) {
    program.stop();
    const Time asked = ScaledClock::host_now();
    while (program.runs() && ScaledClock::host_now() - asked < kToEnd) turn();
    if (!program.runs()) return;
    fail(program.name() + " did not end");
    program.kill();
    while (program.runs()) turn();
  }

  void take_track() {
    for (const TrackPlace& place : read_track(track_file()))
      flight_.track.push_back({.time = Time{} + at_sea(place.host - began_), .position = place.position, .depth = place.depth});
  }

  void fail(std::string why) {
    if (flight_.failure.empty()) flight_.failure = std::move(why);
  }
  bool fail_false(std::string why) {
    fail(std::move(why));
    return false;
  }

  const Case& case_;
  const Bench& bench_;
  BenchFlight flight_;
  SeaEquipment equipment_;
  BusReader bus_;
  const Time launched_utc_ = ScaledClock::utc();
  const Time launched_ = ScaledClock::host_now();
  Time began_ = launched_;  ///< the search, on the host's clock
  SeaProgram earshotd_;
  SeaProgram vehicle_;
  std::vector<InjectedFault> faults_;
  bool is_interface_up_ = true;
  SeaComputer computer_;
  Time polled_ = launched_;  ///< at the track
  bool is_up_ = false;
};

}  // namespace

BenchFlight fly_at_sea(const Case& c, const Bench& bench, const std::filesystem::path& folder) {
  return SeaFlyer(c, bench, folder).fly();
}

}  // namespace earshot::hil
