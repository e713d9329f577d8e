#include "hil/bench/flight/fly_case.hpp"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <memory>
#include <thread>
#include <utility>

#include "firmware/boards/linux/outage/safety_places.hpp"
#include "firmware/host/journal/journal_name.hpp"
#include "firmware/host/mission/mission_file.hpp"
#include "firmware/host/program/child_process.hpp"
#include "hil/bench/at_sea/sea_flight.hpp"
#include "hil/bench/can/can_vehicle_bus.hpp"
#include "hil/bench/disturbance_at.hpp"
#include "hil/bench/lcm/keyed_mission.hpp"
#include "hil/bench/lcm/lcm_vehicle_bus.hpp"
#include "hil/bench/torn_journal.hpp"
#include "hil/bench/vehicle_bus.hpp"
#include "sim/link/run_slot.hpp"
#include "sim/link/simulator_end.hpp"

namespace earshot::hil {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

constexpr milliseconds kPollInterval{50};
constexpr milliseconds kPatience{20'000};  ///< for an answer, on a busy machine
// In the folder of a flight.
constexpr const char* kJournal = "journal.lcmlog";
constexpr const char* kWords = "words.txt";

std::unique_ptr<VehicleBus> open_bus(const Case& c, const Bench& bench, const host::MissionFile& mission, const link::RunSlot& slot) {
  if (c.bus == host::PortKind::kLcm) return std::make_unique<LcmVehicleBus>(c, bench, mission, slot.lcm_url());
  return std::make_unique<CanVehicleBus>(c, bench, mission);
}

bool is_killed_once(const Case& c) {
  return c.has(Fault::kKill) || c.has(Fault::kPowerCut);
}

/// What is left of an earlier flight: an earshotd that is to go on would go on with its journal. Nothing else is touched.
void remove_earlier_flight(const std::filesystem::path& folder) {
  const std::filesystem::path journal = folder / kJournal;
  for (const host::JournalName& name : host::journals_beside(journal)) std::filesystem::remove(host::named(journal, name));
  for (const char* const file : {"journal.policy", "journal.tables", "vehicle.txt", "track.csv", "disk_is_sick", kWords})
    std::filesystem::remove(folder / file);
  for (const host::SafetyCopy& copy : board::safety_places(folder, {}, {})) std::filesystem::remove(copy.file);
  std::filesystem::remove_all(folder / kMemory);
}

/// One flight in the making.
class Flyer {
 public:
  Flyer(const Case& c, const Bench& bench, const std::filesystem::path& folder, link::RunSlot& slot)
      : case_(c),
        bench_(bench),
        mission_(host::load_mission(c.mission)),
        bus_(open_bus(c, bench, mission_, slot)),
        slot_(slot),
        link_(slot.domain(), run_) {
    flight_.folder = folder;
    start();
  }

  BenchFlight fly() {
    const auto began = steady_clock::now();
    try {
      if (!has_come()) fail("earshotd did not answer the simulator's first call");
      fly_on();
    } catch (const std::exception& e) {
      fail(e.what());
    }
    flight_.last = now_;
    end();
    flight_.wall_s = std::chrono::duration<double>(steady_clock::now() - began).count();
    for (std::size_t i = 0; i < case_.faults.size(); ++i) {
      if (!has_acted_[i]) flight_.idle.push_back(case_.faults[i]);
    }
    bus_->report(flight_);
    return std::move(flight_);
  }

 private:
  /// One that will be killed has --resume from the start, as a vehicle's computer has it started every time: no turn is answered before it
  /// is in the journal, so that a SIGKILL costs none that the vehicle has sailed by.
  void start() {
    const std::filesystem::path mission = case_.has(Fault::kRecordedOrder) ? keyed_mission(case_.mission, flight_.folder) : case_.mission;
    std::vector<std::string> a{mission, "--simulation",       std::to_string(slot_.domain()),
                               "--run", std::to_string(run_), "--snr-from-bus",
                               "--out", flight_.folder,       "--quiet"};
    const std::vector<std::string> of_bus = bus_->options_of_earshotd();
    a.insert(a.end(), of_bus.begin(), of_bus.end());
    a.emplace_back(is_killed_once(case_) ? "--resume" : "--replace");
    program::ChildSettings settings{.words = flight_.folder / kWords};
    for (const TimedFault& fault : case_.faults) {
      if (fault.fault == Fault::kFullDisk) settings.most_bytes_of_a_file = static_cast<std::uint64_t>(fault.amount);
    }
    earshotd_ = std::make_unique<program::ChildProcess>(bench_.earshotd, a, settings);
  }

  /// Whether earshotd is there and answers; one that has ended is not waited for.
  [[nodiscard]] bool has_come() {
    for (const auto deadline = steady_clock::now() + kPatience; steady_clock::now() < deadline && !bench_.stop;) {
      if (link_.wait_for_runtime(kPollInterval)) return true;
      if (!is_there()) break;
    }
    return false;
  }

  void fly_on() {
    while (flight_.failure.empty() && !is_over_ && now_ - Time{} < case_.at_most && !bench_.stop) tick();
  }

  void tick() {
    if (!is_time_up_) note_faults();
    bus_->disturb(disturbance_at(case_.faults, now_, kTick));
    if (!is_time_up_) disturb_computer();
    bus_->send_due(now_);
    note_place();
    if (!is_paused_) {
      ++number_;
      send_tick();
      if (!receive_answer()) return;
      bus_->hear(now_, [this] { return is_there(); });
    }
    now_ = now_ + kTick;
  }

  [[nodiscard]] bool receive_answer() {
    for (;;) {
      const auto deadline = steady_clock::now() + kPatience;
      while (steady_clock::now() < deadline && !bench_.stop) {
        link::Answer answer;
        const link::Delivery delivery = link_.receive(answer, kPollInterval);
        if (delivery == link::Delivery::kArrived && answer.number == number_) return take(answer);
        if (!is_there() || delivery == link::Delivery::kLost) break;
      }
      if (!come_back()) return false;
    }
  }

  [[nodiscard]] bool is_there() {
    earshotd_->poll();
    return earshotd_->running();
  }

  /// No fix has to be waited for: what the devices said is in earshotd's socket before the tick is.
  void send_tick() {
    link::Tick tick;
    tick.number = number_;
    tick.time = now_;
    tick.command = order();
    link_.send(tick);
  }

  [[nodiscard]] std::uint8_t order() const {
    if (state_ == messages::MissionState::kStandby) return static_cast<std::uint8_t>(messages::Order::kStart);
    // A search that the vehicle is to end itself nobody ends before it.
    const bool ends_itself = case_.expected.end == messages::EndReason::kFound;
    const bool has_arrived = !ends_itself && bus_->range() <= mission_.mission.step_length;
    return has_arrived ? static_cast<std::uint8_t>(messages::Order::kComplete) : std::uint8_t{0};
  }

  bool take(const link::Answer& answer) {
    state_ = static_cast<messages::MissionState>(answer.state);
    flight_.end = static_cast<messages::EndReason>(answer.end_reason);
    is_over_ = state_ == messages::MissionState::kDone || state_ == messages::MissionState::kAbort;
    return true;
  }

  /// Of an earshotd that was killed on purpose; any other is lost.
  [[nodiscard]] bool come_back() {
    if (!std::exchange(is_killed_, false))
      return fail_false("earshotd was lost, or did not answer for " + std::to_string(kPatience.count() / 1000) + " s");
    wait_for_end();
    link_.give_up_runtime();
    // On a full disk its journal lacks turns that were answered, as after a power cut.
    std::optional<std::uint64_t> turns_kept;
    if (torn_bytes_ > 0 || case_.has(Fault::kFullDisk))
      turns_kept = tear_journal(host::newest_journal_in(flight_.folder), std::exchange(torn_bytes_, 0));
    start();
    if (!has_come()) return fail_false("earshotd did not come back after it was killed");
    if (turns_kept) number_ = std::min(number_, *turns_kept + 1);
    if (link_.turns_made() + 1 < number_ || link_.turns_made() > number_)
      return fail_false("earshotd came back with " + std::to_string(link_.turns_made()) + " turns behind it, in turn " +
                        std::to_string(number_));
    if (link_.turns_made() + 1 == number_) bus_->send_again();
    send_tick();
    return true;
  }

  // Faults.

  void disturb_computer() {
    for (const TimedFault& fault : case_.faults) {
      if (fault.traits().hits == FaultTarget::kComputer && fault.is_new_at(now_, kTick)) begin(fault);
    }
    pause(is_acting(Fault::kPause));
    const bool is_down = is_acting(Fault::kInterfaceDown);
    if (is_down == !is_interface_up_) return;
    bus_->switch_interface(!is_down);
    is_interface_up_ = !is_down;
  }

  void begin(const TimedFault& fault) {
    switch (fault.fault) {
      case Fault::kKill:
        return kill();
      case Fault::kPowerCut:
        torn_bytes_ = static_cast<std::uint64_t>(fault.amount);
        return kill();
      case Fault::kStop:
        return earshotd_->stop();
      case Fault::kPause:
        return;  // earshotd is paused as long as it acts
      case Fault::kFullDisk:
        return;  // earshotd is started with it
      default:
        throw NoMaker(fault.fault, "of the computer in lock-step");
    }
  }

  void kill() {
    is_killed_ = true;
    earshotd_->signal(SIGKILL);
  }

  [[nodiscard]] bool is_acting(Fault kind) const {
    return std::ranges::any_of(case_.faults, [&](const TimedFault& f) { return f.fault == kind && f.acts_at(now_); });
  }

  void pause(bool is_paused) {
    if (std::exchange(is_paused_, is_paused) != is_paused) earshotd_->signal(is_paused ? SIGSTOP : SIGCONT);
  }

  // What is kept.

  /// One that lasts less than a tick may lie between two of them; one of a moment acts in the tick that follows it.
  void note_faults() {
    for (std::size_t i = 0; i < case_.faults.size(); ++i) {
      const TimedFault& fault = case_.faults[i];
      has_acted_[i] = has_acted_[i] || (fault.traits().is_of_a_moment ? fault.is_new_at(now_, kTick) : fault.acts_at(now_));
    }
  }

  void note_place() { flight_.track.push_back({.time = now_, .position = bus_->state().position, .depth = bus_->state().depth}); }

  void fail(std::string why) {
    if (flight_.failure.empty()) flight_.failure = std::move(why);
  }
  bool fail_false(std::string why) {
    fail(std::move(why));
    return false;
  }

  // The end.

  void end() {
    pause(false);
    if (!is_over_) request_stop();
    wait_for_end();
    try {
      if (!is_interface_up_) bus_->switch_interface(true);
    } catch (const std::exception& e) {
      fail(e.what());
    }
  }

  /// It ends in its next turns, for which it would wait in vain without a tick.
  void request_stop() {
    constexpr int kTicks = 5;
    const messages::EndReason when_time_was_up = flight_.end;
    is_time_up_ = true;
    earshotd_->stop();
    for (int i = 0; i < kTicks && flight_.failure.empty() && !is_over_ && !bench_.stop && is_there(); ++i) tick();
    flight_.end = when_time_was_up;
  }

  void wait_for_end() {
    for (const auto deadline = steady_clock::now() + kPatience; is_there() && steady_clock::now() < deadline;)
      std::this_thread::sleep_for(milliseconds(2));
    if (earshotd_->running()) {
      fail("earshotd did not end");
      earshotd_->signal(SIGKILL);
      while (earshotd_->running()) earshotd_->poll();
    }
    flight_.exit_statuses.push_back(earshotd_->status());
    flight_.last_words = program::last_words(flight_.folder / kWords);
  }

  const Case& case_;
  const Bench& bench_;
  host::MissionFile mission_;
  Time now_;
  std::unique_ptr<VehicleBus> bus_;
  link::RunSlot& slot_;
  link::RunId run_ = link::new_run();
  link::SimulatorEnd link_;
  std::unique_ptr<program::ChildProcess> earshotd_;
  std::uint64_t number_ = 0;
  messages::MissionState state_ = messages::MissionState::kStandby;  ///< by the last answer
  bool is_over_ = false;
  bool is_time_up_ = false;  ///< no fault of the computer begins any more
  bool is_killed_ = false;
  std::uint64_t torn_bytes_ = 0;  ///< that its journal lost with the power
  bool is_paused_ = false;        ///< it does not run, and no turn is asked of it
  bool is_interface_up_ = true;
  std::vector<bool> has_acted_ = std::vector<bool>(case_.faults.size());  ///< of the case's faults
  BenchFlight flight_;
};

}  // namespace

BenchFlight fly_case(const Case& c, const Bench& bench, const std::filesystem::path& folder) {
  try {
    std::filesystem::create_directories(folder);
    remove_earlier_flight(folder);
    if (c.speed) return fly_at_sea(c, bench, folder);
    link::RunSlot slot;
    return Flyer(c, bench, folder, slot).fly();
  } catch (const NotFlown& e) {
    BenchFlight none;
    none.folder = folder;
    none.not_flown = e.what();
    return none;
  } catch (const std::exception& e) {
    BenchFlight none;
    none.folder = folder;
    none.failure = e.what();
    return none;
  }
}

}  // namespace earshot::hil
