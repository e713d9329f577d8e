#include "hil/bench/lcm/lcm_vehicle_bus.hpp"

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>

#include "firmware/wire/lcm/channels.hpp"
#include "firmware/wire/lcm/encoding.hpp"

namespace earshot::hil {
namespace {

constexpr std::size_t kTracedMessages = 50'000;  ///< two hours without a flood, in 10 MB
constexpr int kPatience_ms = 5000;               ///< for what was sent before its answer

LcmVehicleSetup setup_of(const Case& c, const Bench& bench, const host::MissionFile& mission) {
  return {.start = {.position = c.start,
                    .depth = mission.mission.search_depth,
                    .heading = c.start_heading(),
                    .speed = mission.mission.search_speed},
          .source = {.position = c.source, .snr = bench.snr},
          .sea_floor = {.depth = bench.floor_depth}};
}

/// Earshot's health is the last thing that it says in a turn.
bool is_end_of_turn(const LcmMessage& message, Time now) {
  messages::Health health;
  Time sent;
  return message.channel == wire::kHealthChannel && wire::decode(message.data, health, &sent) == Status::kOk && sent == now;
}

/// What LCM makes of a datagram, if it is whole.
std::optional<LcmMessage> message_of(const Datagram& datagram, wire::Reassembly& reassembly) {
  wire::Lc02Message message;
  if (reassembly.accept(datagram, {}, message) != Status::kOk) return std::nullopt;
  return LcmMessage{.channel = std::string(message.channel), .data = {message.data.begin(), message.data.end()}};
}

}  // namespace

LcmVehicleBus::LcmVehicleBus(const Case& c, const Bench& bench, const host::MissionFile& mission, std::string url)
    : case_(c),
      url_(std::move(url)),
      vehicle_(setup_of(c, bench, mission)),
      rogue_nodes_(c.faults, vehicle_.state(), bench.seed),
      to_earshot_(bench.seed),
      to_vehicle_(bench.seed + 1),
      network_(host::parse_lcm_url(url_)) {}

void LcmVehicleBus::send_due(Time now) {
  now_ = now;
  due_.clear();
  vehicle_.step(now, due_);
  rogue_nodes_.step(now, due_);
  arriving_ = to_earshot_.pass(due_, afflictions(false), now);
  send_again();
}

void LcmVehicleBus::send_again() {
  const auto reassembly = std::make_unique<wire::Reassembly>();
  for (const Datagram& datagram : arriving_) {
    if (!network_.send(datagram)) throw BusTrouble("the network does not carry the bench's datagrams");
    ++sent_;
    trace(message_of(datagram, *reassembly).value_or(LcmMessage{.channel = "?", .data = datagram}), false);
  }
}

void LcmVehicleBus::hear(Time now, const std::function<bool()>& /*is_there*/) {
  LcmMessages heard;
  do {
    std::optional<LcmMessage> message = network_.receive(kPatience_ms);
    if (!message) throw BusTrouble("of the end of its turn Earshot sent nothing on the bus");
    ++received_;
    trace(*message, true);
    heard.push_back(std::move(*message));
  } while (!is_end_of_turn(heard.back(), now));
  const auto reassembly = std::make_unique<wire::Reassembly>();
  for (const Datagram& datagram : to_vehicle_.pass(heard, afflictions(true), now)) {
    if (const std::optional<LcmMessage> message = message_of(datagram, *reassembly)) vehicle_.accept(*message, now);
  }
}

void LcmVehicleBus::report(BenchFlight& flight) {
  flight.sent = sent_;
  flight.received = received_;
  flight.afflicted = to_earshot_.afflicted() + to_vehicle_.afflicted();
  flight.messages = std::move(trace_);
  flight.is_weight_released = vehicle_.helm().is_weight_released();
}

std::vector<MessageAffliction> LcmVehicleBus::afflictions(bool of_earshot) const {
  std::vector<MessageAffliction> found;
  for (const TimedFault& fault : case_.faults) {
    if (fault.traits().hits != FaultTarget::kFrames || !fault.acts_at(now_)) continue;
    if (!fault.device.empty() && (fault.device == kEarshotsFrames) != of_earshot) continue;
    found.push_back({.fault = fault.fault,
                     .sender = fault.device,
                     .share = fault.share,
                     .seconds = Duration{static_cast<std::int64_t>(fault.amount * 1e6)}});
  }
  return found;
}

void LcmVehicleBus::trace(const LcmMessage& message, bool from_earshot) {
  if (trace_.size() == kTracedMessages) trace_.pop_front();
  trace_.push_back({.time = now_, .from_earshot = from_earshot, .message = message});
}

}  // namespace earshot::hil
