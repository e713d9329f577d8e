#include "firmware/boards/linux/can/can_port.hpp"

#include "firmware/wire/n2k/setpoint.hpp"
#include "firmware/wire/n2k/table/messages.hpp"

namespace earshot::board {
namespace {

constexpr unsigned long long bit(BusTrouble trouble) {
  return 1ULL << static_cast<unsigned>(trouble);
}
/// Those that leave positions without a fix.
constexpr BusTroubles kPartsMissing{bit(BusTrouble::kNoHeading) | bit(BusTrouble::kOtherHeading) | bit(BusTrouble::kNoVariation) |
                                    bit(BusTrouble::kNoDepth) | bit(BusTrouble::kOtherPressure) | bit(BusTrouble::kSurfaceUnknown)};

}  // namespace

CanPort::CanPort(std::uint8_t index, const host::PortSettings& settings, const n2k::LocalPlane& plane, const HostClock& host,
                 host::IfMissing if_missing)
    : Port(index, settings.roles),
      label_(settings.name + ", CAN " + settings.address),
      device_(settings, host, if_missing),
      vehicle_(index, plane, settings.n2k.navigation),
      surface_zero_(settings.n2k.zero_pressure_at_surface),
      snr_(index, settings.n2k.snr_source),
      autopilot_(index, settings.n2k.autopilot_source),
      orders_(index, settings.command_proof, device_),
      status_(device_),
      troubles_(index, settings.roles, settings.n2k.navigation.oldest_part) {}

bool CanPort::settle() {
  if (!device_.is_up()) return true;
  device_.read([this](const n2k::HeardFrame& heard, Time /*received_utc*/) { vehicle_.note_claim(heard); });
  device_.serve();
  return device_.address().has_value();
}

void CanPort::collect(Clock& clock, InputSink& sink) {
  device_.read([&](const n2k::HeardFrame& heard, Time received_utc) {
    take(heard, {.utc = received_utc, .mission = clock.arrival_of(received_utc)}, clock, sink);
  });
  vehicle_.give_status(clock.now(), sink);
  troubles_.check(device_.is_up(), signs(), {.host = device_.now(), .mission = clock.now()}, sink);
}

void CanPort::take(const n2k::HeardFrame& heard, const Arrival& arrival, Clock& clock, InputSink& sink) {
  if (!heard.identifier.ok()) return;
  const n2k::Directory& directory = vehicle_.sensors().directory();
  switch (heard.identifier.value().pgn) {
    case n2k::kPeerPgn:
      if (has(host::Role::kOperator)) orders_.take(heard, arrival, clock, sink);
      return;
    case n2k::kSnrPgn:
      if (has(host::Role::kSnr)) count_refusal(snr_.take(heard, arrival, directory, sink));
      return;
    case n2k::kLeakPgn:
      if (has(host::Role::kNavigation)) count_refusal(vehicle_.take_hull(heard, arrival));
      return;
    case n2k::kAutopilotStatusPgn:
      if (has(host::Role::kAutopilot)) count_refusal(autopilot_.take(heard, arrival, directory, sink));
      return;
    case n2k::kAddressClaimPgn:  // the SNR's device may be known by its NAME, too
      return vehicle_.take(heard, arrival, sink);
    default:
      if (has(host::Role::kNavigation)) vehicle_.take(heard, arrival, sink);
  }
}

/// Of messages of Earshot's own groups. Another maker's message is none, nor is a device's that says it has no value.
void CanPort::count_refusal(Status status) {
  if (status != Status::kOk && status != Status::kUnsupported && status != Status::kNotReady) ++report_.malformed;
}

std::uint64_t CanPort::publish(Time now, const runtime::Outputs& outputs) {
  surface_zero_.note_turn(now, outputs, vehicle_);
  orders_.end_turn();
  std::uint64_t setpoints = 0;
  if (has(host::Role::kAutopilot) && outputs.setpoint && publish_setpoint(*outputs.setpoint)) ++setpoints;
  if (has(host::Role::kOperator)) {
    orders_.acknowledge(outputs);
    orders_.publish_challenge(now);
  }
  if (has(host::Role::kStatus)) status_.publish(now, outputs);
  return setpoints;
}

bool CanPort::publish_setpoint(const messages::Setpoint& setpoint) {
  const auto compose = [&](std::uint8_t address, n2k::SetpointFrames& frames) {
    return n2k::compose_setpoint(setpoint, address, setpoint_sequence_++, frames);
  };
  return device_.send<n2k::SetpointFrames>(compose, {.kept = host::WhileWaiting::kKeepNewest});
}

messages::PortReport CanPort::report() const {
  messages::PortReport report = report_;
  report.received += vehicle_.fixes() + vehicle_.statuses() + snr_.measurements() + autopilot_.statuses() + orders_.taken();
  report.malformed += vehicle_.counters().malformed + orders_.refused();
  device_.add_to(report);
  return report;
}

BusSigns CanPort::signs() const {
  const messages::PortReport now = report();
  const n2k::SensorCounters& sensors = vehicle_.sensors().counters();
  const auto not_chosen = [&](n2k::Measured measured) { return sensors.not_chosen[static_cast<std::size_t>(measured)]; };
  return {.has_address = device_.address().has_value(),
          .own_name_claims = device_.own_name_claims(),
          .controller = device_.controller_state(),
          .frames_lost = now.lost,
          .unsent = now.unsent - device_.without_address(),
          .fixes = vehicle_.fixes(),
          .measurements = snr_.measurements(),
          .no_variation = sensors.no_variation,
          .not_chosen = {.position = not_chosen(n2k::Measured::kPosition),
                         .heading = not_chosen(n2k::Measured::kHeading),
                         .pressure = not_chosen(n2k::Measured::kPressure),
                         .snr = snr_.not_chosen()},
          .readings = vehicle_.sensors().readings()};
}

std::string CanPort::remark() const {
  const messages::PortReport counts = report();
  const host::CanCounters can = device_.counters();
  std::string text;
  const auto add = [&text](std::uint64_t count, const std::string& what) {
    if (count > 0) text += (text.empty() ? "" : "; ") + std::to_string(count) + what;
  };
  add(counts.lost,
      " frames lost on their way in, because they came faster than they were read and the socket's or the controller's buffer was full: "
      "lighten the bus, or raise sysctl net.core.rmem_max");
  add(counts.unsent - device_.without_address(),
      " messages could not be sent, because the interface was down or nobody on the bus took its frames: check its state (ip -d -s "
      "link)");
  add(device_.without_address(), " messages could not be sent, because there was no address on the bus: devices with more rights had it");
  add(can.controller.bus_off,
      " times the controller left the bus after too many errors: check the cables, their two ends and the bit rate");
  // A few positions come before the first heading and the first pressure on every voyage.
  if ((troubles_.met() & kPartsMissing).any())
    add(vehicle_.counters().waiting,
        " positions made no fix, because heading or pressure was missing or older than oldest_part_s: check how often their devices "
        "send");
  if (troubles_.met()[static_cast<std::size_t>(BusTrouble::kSameName)])
    text += (text.empty() ? "" : "; ") + std::string(begin_of(BusTrouble::kSameName));
  return text.empty() ? text : label_ + ": " + text;
}

}  // namespace earshot::board
