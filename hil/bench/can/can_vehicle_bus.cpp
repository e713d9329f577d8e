#include "hil/bench/can/can_vehicle_bus.hpp"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <thread>
#include <utility>

#include "firmware/wire/n2k/signals.hpp"
#include "hil/bus/interface_switch.hpp"

namespace earshot::hil {
namespace {

using std::chrono::steady_clock;

/// earshotd tries a lost interface again in the first turn that is a second later than its last trial, by the host's clock.
constexpr std::chrono::milliseconds kToTryAgain{1100};
/// An address is claimed in 0.25 s of the host's clock, up to 0.4 s. Whatever a fault leaves of it, the flight goes on then.
constexpr std::chrono::milliseconds kToClaim{5000};
constexpr std::size_t kTracedFrames = 400'000;  ///< two hours without a flood, in 13 MB: a rule may fire long before the end

VehicleSetup setup_of(const Case& c, const Bench& bench, const host::MissionFile& mission) {
  VehicleSetup setup;
  setup.start = {
      .position = c.start, .depth = mission.mission.search_depth, .heading = c.start_heading(), .speed = mission.mission.search_speed};
  setup.plane = mission.plane;
  setup.source = {.position = c.source, .snr = bench.snr};
  setup.sea_floor.depth = bench.floor_depth;
  setup.without = {"operator"};  // orders ride on the tick: those of the bus are dated by the wall clock
  return setup;
}

}  // namespace

CanVehicleBus::CanVehicleBus(const Case& c, const Bench& bench, const host::MissionFile& mission)
    : case_(c),
      interface_(bench.interface),
      vehicle_(setup_of(c, bench, mission)),
      rogue_nodes_(c.faults, vehicle_.state(), mission.plane),
      to_earshot_(bench.seed),
      to_vehicle_(bench.seed + 1),
      socket_(bench.interface) {}

void CanVehicleBus::send_due(Time now) {
  now_ = now;
  Frames due;
  vehicle_.step(now, due);
  for (const n2k::Frame& frame : due) rogue_nodes_.accept(frame, now);
  Frames intruding;
  rogue_nodes_.step(now, intruding);
  for (const n2k::Frame& frame : intruding) vehicle_.accept(frame, now);
  due.insert(due.end(), intruding.begin(), intruding.end());
  if (rogue_nodes_.fill_bus(now)) std::erase_if(due, [](const n2k::Frame& frame) { return frame.identifier != kFloodIdentifier; });
  arriving_ = to_earshot_.pass(due, afflictions(false), now);
  send_again();
}

void CanVehicleBus::send_again() {
  for (const n2k::Frame& frame : arriving_) send(frame);
}

void CanVehicleBus::hear(Time now, const std::function<bool()>& is_there) {
  Frames heard;
  const auto steals = [now](const TimedFault& fault) { return fault.fault == Fault::kAddressThief && fault.is_new_at(now, kTick); };
  if (std::exchange(is_back_, false) || std::ranges::any_of(case_.faults, steals)) wait_for_claim(is_there, heard);
  receive(heard);
  if (rogue_nodes_.fill_bus(now)) heard.clear();
  for (const n2k::Frame& frame : to_vehicle_.pass(heard, afflictions(true), now)) {
    vehicle_.accept(frame, now);
    rogue_nodes_.accept(frame, now);
  }
}

void CanVehicleBus::switch_interface(bool is_up) {
  hil::switch_interface(interface_, is_up);
  if (!is_up) return;
  (void)socket_.reopen();
  std::this_thread::sleep_for(kToTryAgain);
  is_back_ = true;
}

void CanVehicleBus::report(BenchFlight& flight) {
  flight.sent = sent_;
  flight.received = received_;
  flight.lost = socket_.counters().lost_by_kernel;
  flight.afflicted = to_earshot_.afflicted() + to_vehicle_.afflicted();
  flight.trace = std::move(trace_);
  flight.is_weight_released = vehicle_.autopilot()->is_weight_released();
}

std::vector<Affliction> CanVehicleBus::afflictions(bool of_earshot) const {
  std::vector<Affliction> found;
  for (const TimedFault& fault : case_.faults) {
    if (fault.traits().hits != FaultTarget::kFrames || !fault.acts_at(now_)) continue;
    std::optional<std::uint8_t> source;
    if (!fault.device.empty()) {
      if ((fault.device == kEarshotsFrames) != of_earshot) continue;
      if (!of_earshot) source = vehicle_.address_of(fault.device);
      if (!of_earshot && !source) continue;  // who has no address says nothing
    }
    found.push_back({.fault = fault.fault,
                     .frames = {.source = source, .pgn = fault.pgn, .share = fault.share},
                     .seconds = Duration{static_cast<std::int64_t>(fault.amount * 1e6)}});
  }
  return found;
}

void CanVehicleBus::send(const n2k::Frame& frame) {
  const auto deadline = steady_clock::now() + std::chrono::seconds(2);
  while (socket_.is_up() && socket_.send(frame) != Status::kOk) {
    if (steady_clock::now() > deadline) throw BusTrouble("the bus takes no frames");
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  if (!socket_.is_up()) return;
  ++sent_;
  trace(frame, false);
}

void CanVehicleBus::receive(Frames& heard) {
  for (n2k::Frame frame; socket_.receive(frame) == Status::kOk;) {
    ++received_;
    trace(frame, true);
    heard.push_back(frame);
  }
}

void CanVehicleBus::wait_for_claim(const std::function<bool()>& is_there, Frames& heard) {
  const auto is_question = [](const n2k::Frame& frame) { return n2k::parse_identifier(frame.identifier).value().pgn == n2k::kRequestPgn; };
  for (const auto deadline = steady_clock::now() + kToClaim; steady_clock::now() < deadline;
       std::this_thread::sleep_for(std::chrono::milliseconds(5))) {
    const auto before = static_cast<std::ptrdiff_t>(heard.size());
    receive(heard);
    if (!is_there() || std::any_of(heard.begin() + before, heard.end(), is_question)) return;
  }
}

void CanVehicleBus::trace(const n2k::Frame& frame, bool from_earshot) {
  if (trace_.size() == kTracedFrames) trace_.pop_front();
  trace_.push_back({.time = now_, .from_earshot = from_earshot, .frame = frame});
}

}  // namespace earshot::hil
