#include "hil/bench/can/can_vehicle_bus.hpp"

#include <algorithm>
#include <chrono>
#include <thread>
#include <utility>

#include "hil/bench/interface_switch.hpp"

namespace earshot::hil {
namespace {

using std::chrono::steady_clock;

/// What earshotd does on the bus by the host's clock: an interface is tried again once a second, an address is claimed in 0.25 s.
constexpr std::chrono::milliseconds kToNoticeTheBus{2500};
constexpr std::size_t kTracedFrames = 400'000;  ///< two hours without a flood, in 13 MB: a rule may fire long before the end

VehicleSetup setup_of(const Case& c, const Bench& bench, const host::MissionFile& mission) {
  VehicleSetup setup;
  setup.start = {.position = c.start, .depth = mission.mission.search_depth, .heading = {}, .speed = mission.mission.search_speed};
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
      intruders_(c.faults, vehicle_.state(), mission.plane),
      to_earshot_(bench.seed),
      to_vehicle_(bench.seed + 1),
      socket_(bench.interface) {}

void CanVehicleBus::say(Time now) {
  now_ = now;
  Frames said;
  vehicle_.step(now, said);
  for (const n2k::Frame& frame : said) intruders_.accept(frame, now);
  Frames intruding;
  intruders_.step(now, intruding);
  for (const n2k::Frame& frame : intruding) vehicle_.accept(frame, now);
  said.insert(said.end(), intruding.begin(), intruding.end());
  arriving_ = to_earshot_.pass(said, afflictions(false), now);
  say_again();
}

void CanVehicleBus::say_again() {
  for (const n2k::Frame& frame : arriving_) send(frame);
}

void CanVehicleBus::hear(Time now) {
  Frames heard;
  for (n2k::Frame frame; socket_.receive(frame) == Status::kOk;) {
    ++received_;
    trace(frame, true);
    heard.push_back(frame);
  }
  for (const n2k::Frame& frame : to_vehicle_.pass(heard, afflictions(true), now)) {
    vehicle_.accept(frame, now);
    intruders_.accept(frame, now);
  }
  const auto claims = [now](const TimedFault& fault) { return fault.fault == Fault::kAddressThief && fault.begins_in(now, kTick); };
  if (std::ranges::any_of(case_.faults, claims)) std::this_thread::sleep_for(kToNoticeTheBus);
}

void CanVehicleBus::switch_interface(bool is_up) {
  hil::switch_interface(interface_, is_up);
  std::this_thread::sleep_for(kToNoticeTheBus);
  (void)socket_.reopen();
}

void CanVehicleBus::report(BenchFlight& flight) {
  flight.sent = sent_;
  flight.received = received_;
  flight.lost = socket_.counters().lost_by_kernel;
  flight.afflicted = to_earshot_.afflicted() + to_vehicle_.afflicted();
  flight.trace = std::move(trace_);
}

std::vector<Affliction> CanVehicleBus::afflictions(bool of_earshot) const {
  std::vector<Affliction> found;
  for (const TimedFault& fault : case_.faults) {
    const auto index = static_cast<std::size_t>(fault.fault);
    const bool names_earshot = fault.device == "earshot";
    if (!fault.acts_at(now_) || index >= kFrameFaults || (!fault.device.empty() && names_earshot != of_earshot)) continue;
    const std::optional<std::uint8_t> source = fault.device.empty() || names_earshot ? std::nullopt : vehicle_.address_of(fault.device);
    if (!fault.device.empty() && !names_earshot && !source) continue;
    found.push_back({.fault = static_cast<FrameFault>(index),
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

void CanVehicleBus::trace(const n2k::Frame& frame, bool from_earshot) {
  if (trace_.size() == kTracedFrames) trace_.pop_front();
  trace_.push_back({.time = now_, .from_earshot = from_earshot, .frame = frame});
}

}  // namespace earshot::hil
