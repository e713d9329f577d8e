#include "hil/bench/bench_flight.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <memory>
#include <thread>
#include <utility>

#include "firmware/host/mission/mission_file.hpp"
#include "firmware/host/program/child_process.hpp"
#include "firmware/host/transport/can_socket.hpp"
#include "hil/bench/bad_bus.hpp"
#include "hil/bench/disturbance_at.hpp"
#include "hil/bench/interface_switch.hpp"
#include "hil/bench/intruders.hpp"
#include "hil/nodes/emulated_vehicle.hpp"
#include "sim/link/run_slot.hpp"
#include "sim/link/simulator_end.hpp"

namespace earshot::hil {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

constexpr Duration kTick = Duration::seconds(1);
constexpr milliseconds kLookUp{50};
constexpr milliseconds kPatience{20'000};  ///< for an answer, on a busy machine
/// earshotd tries a lost interface again in the first turn that is a second later than its last trial, by the host's clock.
constexpr milliseconds kToTryAgain{1100};
/// An address is claimed in 0.25 s of the host's clock, up to 0.4 s. Whatever a fault leaves of it, the flight goes on then.
constexpr milliseconds kToClaim{5000};
constexpr std::size_t kTracedFrames = 400'000;  ///< two hours without a flood, in 13 MB: a rule may fire long before the end

/// One flight in the making.
class Flyer {
 public:
  Flyer(const Case& c, const Bench& bench, const std::filesystem::path& folder, link::RunSlot& slot)
      : case_(c),
        bench_(bench),
        mission_(host::load_mission(c.mission)),
        vehicle_(setup()),
        intruders_(c.faults, vehicle_.state(), mission_.plane),
        to_earshot_(bench.seed),
        to_vehicle_(bench.seed + 1),
        slot_(slot),
        link_(slot.domain(), run_),
        socket_(bench.interface) {
    flight_.folder = folder;
    start(false);
  }

  BenchFlight fly() {
    const auto began = steady_clock::now();
    if (!link_.wait_for_runtime(kPatience)) {
      fail("earshotd did not answer the simulator's first call");
    }
    while (flight_.failure.empty() && !is_over_ && now_ - Time{} < case_.at_most && !bench_.stop) tick();
    end();
    flight_.last = now_;
    flight_.wall_s = std::chrono::duration<double>(steady_clock::now() - began).count();
    flight_.sent = sent_;
    flight_.received = received_;
    flight_.lost = socket_.counters().lost_by_kernel;
    flight_.afflicted = to_earshot_.afflicted() + to_vehicle_.afflicted();
    return std::move(flight_);
  }

 private:
  [[nodiscard]] VehicleSetup setup() const {
    VehicleSetup setup;
    setup.start = {.position = case_.start, .depth = mission_.mission.search_depth, .heading = {}, .speed = mission_.mission.search_speed};
    setup.plane = mission_.plane;
    setup.source = {.position = case_.source, .snr = bench_.snr};
    setup.sea_floor.depth = bench_.floor_depth;
    setup.without = {"operator"};  // orders ride on the tick: those of the bus are dated by the wall clock
    return setup;
  }

  void start(bool is_return) {
    std::vector<std::string> a{case_.mission,
                               "--simulation",
                               std::to_string(slot_.domain()),
                               "--run",
                               std::to_string(run_),
                               "--snr-from-bus",
                               "--can-interface",
                               bench_.interface,
                               "--out",
                               flight_.folder,
                               "--quiet"};
    // With --resume no turn is answered before it is in the journal: a SIGKILL costs none that the vehicle has sailed by.
    a.emplace_back(is_return || is_to_die() ? "--resume" : "--replace");
    program::ChildSettings settings{.words = flight_.folder / "words.txt"};
    for (const TimedFault& fault : case_.faults) {
      if (fault.fault == Fault::kFullDisk) settings.most_bytes_of_a_file = static_cast<std::uint64_t>(fault.amount);
    }
    earshotd_ = std::make_unique<program::ChildProcess>(bench_.earshotd, a, settings);
  }

  void tick() {
    vehicle_.disturb(disturbance_at(case_.faults, now_, kTick));
    disturb_computer();
    Frames said;
    vehicle_.step(now_, said);
    for (const n2k::Frame& frame : said) intruders_.accept(frame, now_);
    Frames intruding;
    intruders_.step(now_, intruding);
    for (const n2k::Frame& frame : intruding) vehicle_.accept(frame, now_);
    said.insert(said.end(), intruding.begin(), intruding.end());
    arriving_ = to_earshot_.pass(said, afflictions(false), now_);
    for (const n2k::Frame& frame : arriving_) send(frame);
    note_place();
    ++number_;
    say_tick();
    if (!receive_answer()) return;
    if (std::exchange(is_claim_due_, false)) wait_for_claim();
    take_frames();
    now_ = now_ + kTick;
  }

  void send(const n2k::Frame& frame) {
    const auto deadline = steady_clock::now() + std::chrono::seconds(2);
    while (socket_.is_up() && socket_.send(frame) != Status::kOk) {
      if (steady_clock::now() > deadline) return fail("the bus takes no frames");
      std::this_thread::sleep_for(milliseconds(1));
    }
    if (!socket_.is_up()) return;
    ++sent_;
    trace(frame, false);
  }

  void hear() {
    for (n2k::Frame frame; socket_.receive(frame) == Status::kOk;) {
      ++received_;
      trace(frame, true);
      heard_.push_back(frame);
    }
  }

  void take_frames() {
    hear();
    for (const n2k::Frame& frame : to_vehicle_.pass(std::exchange(heard_, {}), afflictions(true), now_)) {
      vehicle_.accept(frame, now_);
      intruders_.accept(frame, now_);
    }
  }

  [[nodiscard]] bool receive_answer() {
    for (;;) {
      const auto deadline = steady_clock::now() + kPatience;
      while (steady_clock::now() < deadline && !bench_.stop) {
        link::Answer answer;
        const link::Delivery delivery = link_.receive(answer, kLookUp);
        if (delivery == link::Delivery::kArrived && answer.number == number_) return take(answer);
        earshotd_->poll();
        if (delivery == link::Delivery::kLost || !earshotd_->running()) break;
      }
      if (!come_back()) return false;
    }
  }

  /// No fix has to be waited for: what the devices said is in earshotd's socket before the tick is.
  void say_tick() {
    link::Tick tick;
    tick.number = number_;
    tick.time = now_;
    tick.command = order();
    link_.send(tick);
  }

  [[nodiscard]] std::uint8_t order() const {
    if (state_ == messages::MissionState::kStandby) return static_cast<std::uint8_t>(messages::Order::kStart);
    const bool has_arrived = vehicle_.range() <= mission_.mission.step_length;
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
    start(true);
    if (!link_.wait_for_runtime(kPatience)) return fail_false("earshotd did not come back after it was killed");
    if (link_.turns_made() + 1 < number_ || link_.turns_made() > number_) return fail_false("earshotd came back to another turn");
    if (link_.turns_made() + 1 == number_) {
      for (const n2k::Frame& frame : arriving_) send(frame);
    }
    say_tick();
    return true;
  }

  // Faults.

  /// @param of_earshot  what befalls its frames; else: those of all others
  [[nodiscard]] std::vector<Affliction> afflictions(bool of_earshot) const {
    std::vector<Affliction> found;
    for (const TimedFault& fault : case_.faults) {
      const auto index = static_cast<std::size_t>(fault.fault);
      if (index >= kFrameFaults || !fault.acts_at(now_)) continue;
      std::optional<std::uint8_t> source;
      if (!fault.device.empty()) {
        if ((fault.device == kEarshotsFrames) != of_earshot) continue;
        if (!of_earshot) source = vehicle_.address_of(fault.device);
        if (!of_earshot && !source) continue;  // who has no address says nothing
      }
      found.push_back({.fault = static_cast<FrameFault>(index),
                       .frames = {.source = source, .pgn = fault.pgn, .share = fault.share},
                       .seconds = Duration{static_cast<std::int64_t>(fault.amount * 1e6)}});
    }
    return found;
  }

  void disturb_computer() {
    for (const TimedFault& fault : case_.faults) {
      if (!is_news(fault)) continue;
      if (fault.fault == Fault::kAddressThief) {
        is_claim_due_ = true;
      } else if (fault.fault == Fault::kKill) {
        is_killed_ = true;
        earshotd_->signal(SIGKILL);
      } else if (fault.fault == Fault::kStop) {
        earshotd_->stop();
      } else if (fault.fault == Fault::kPause) {
        earshotd_->signal(SIGSTOP);
        std::this_thread::sleep_for(std::chrono::duration<double>(fault.amount));
        earshotd_->signal(SIGCONT);
      }
    }
    const bool is_down =
        std::ranges::any_of(case_.faults, [this](const TimedFault& f) { return f.fault == Fault::kInterfaceDown && f.acts_at(now_); });
    if (is_down == !is_interface_up_) return;
    is_interface_up_ = !is_down;
    switch_interface(bench_.interface, is_interface_up_);
    if (is_down) return;
    (void)socket_.reopen();
    std::this_thread::sleep_for(kToTryAgain);
    is_claim_due_ = true;
  }

  /// Until Earshot has an address again, as its first question on the bus says: whose addresses are there?
  void wait_for_claim() {
    const auto is_first_question = [](const n2k::Frame& frame) {
      return n2k::parse_identifier(frame.identifier).value().pgn == n2k::kRequestPgn;
    };
    for (const auto deadline = steady_clock::now() + kToClaim; steady_clock::now() < deadline;
         std::this_thread::sleep_for(milliseconds(5))) {
      earshotd_->poll();
      const std::size_t before = heard_.size();
      hear();
      if (!earshotd_->running() || std::any_of(heard_.begin() + static_cast<std::ptrdiff_t>(before), heard_.end(), is_first_question))
        return;
    }
  }

  [[nodiscard]] bool is_news(const TimedFault& fault) const { return fault.is_new_at(now_, kTick); }
  [[nodiscard]] bool is_to_die() const { return std::ranges::find(case_.faults, Fault::kKill, &TimedFault::fault) != case_.faults.end(); }

  // What is kept.

  void note_place() { flight_.track.push_back({.time = now_, .position = vehicle_.state().position, .depth = vehicle_.state().depth}); }

  void trace(const n2k::Frame& frame, bool from_earshot) {
    if (flight_.trace.size() == kTracedFrames) flight_.trace.pop_front();
    flight_.trace.push_back({.time = now_, .from_earshot = from_earshot, .frame = frame});
  }

  void fail(std::string why) {
    if (flight_.failure.empty()) flight_.failure = std::move(why);
  }
  bool fail_false(std::string why) {
    fail(std::move(why));
    return false;
  }

  // The end.

  void end() {
    if (!is_over_) earshotd_->stop();
    wait_for_end();
    if (!is_interface_up_) switch_interface(bench_.interface, true);
  }

  void wait_for_end() {
    for (const auto deadline = steady_clock::now() + kPatience; earshotd_->running() && steady_clock::now() < deadline;) {
      earshotd_->poll();
      std::this_thread::sleep_for(milliseconds(2));
    }
    if (earshotd_->running()) {
      fail("earshotd did not end");
      earshotd_->signal(SIGKILL);
      while (earshotd_->running()) earshotd_->poll();
    }
    flight_.exit_statuses.push_back(earshotd_->status());
  }

  const Case& case_;
  const Bench& bench_;
  host::MissionFile mission_;
  Time now_;
  EmulatedVehicle vehicle_;
  Intruders intruders_;
  BadBus to_earshot_;
  BadBus to_vehicle_;
  link::RunSlot& slot_;
  link::RunId run_ = link::new_run();
  link::SimulatorEnd link_;
  host::CanSocket socket_;
  std::unique_ptr<program::ChildProcess> earshotd_;
  Frames arriving_;  ///< of this tick
  Frames heard_;     ///< of Earshot since the last
  std::uint64_t number_ = 0;
  std::uint64_t sent_ = 0;
  std::uint64_t received_ = 0;
  messages::MissionState state_ = messages::MissionState::kStandby;  ///< by the last answer
  bool is_over_ = false;
  bool is_killed_ = false;
  bool is_interface_up_ = true;
  bool is_claim_due_ = false;  ///< Earshot has to claim an address in this turn
  BenchFlight flight_;
};

}  // namespace

BenchFlight fly_case(const Case& c, const Bench& bench, const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (name == "words.txt" || name.starts_with("journal")) std::filesystem::remove(entry.path());
  }
  link::RunSlot slot;
  return Flyer(c, bench, folder, slot).fly();
}

}  // namespace earshot::hil
