#include "firmware/boards/linux/can/can_port.hpp"

#include <algorithm>
#include <cstddef>

#include "firmware/host/program/version.hpp"
#include "firmware/wire/n2k/identifier.hpp"
#include "firmware/wire/n2k/own/conditions.hpp"
#include "firmware/wire/n2k/own/measurements.hpp"
#include "firmware/wire/n2k/own/reports.hpp"
#include "firmware/wire/n2k/table/messages.hpp"

namespace earshot::board {
namespace {

constexpr std::size_t kLongestText = 32;  ///< of product information

/// Between two reports of an unchanged state, at least: the table's period, less what turns of one second are apart from a second.
constexpr Duration kStatusPeriod{n2k::table::kHealth.period.us * 9 / 10};

constexpr unsigned long long bit(BusTrouble trouble) {
  return 1ULL << static_cast<unsigned>(trouble);
}
/// Those that leave positions without a fix.
constexpr BusTroubles kPartsMissing{bit(BusTrouble::kNoHeading) | bit(BusTrouble::kOtherHeading) | bit(BusTrouble::kNoVariation) |
                                    bit(BusTrouble::kNoDepth) | bit(BusTrouble::kOtherPressure) | bit(BusTrouble::kSurfaceUnknown)};

/// How many frames from the first on go together: those of one group, as the longest packets come in one step. Two of them in a row may.
std::size_t frames_together(std::span<const n2k::Frame> frames) {
  const std::size_t most = std::min(frames.size(), host::CanGroup::capacity());
  std::size_t count = 1;
  while (count < most && frames[count].identifier == frames[0].identifier) ++count;
  return count;
}

bool is_new(const std::optional<messages::Health>& published, const messages::Health& health) {
  return !published || published->state != health.state || published->end_reason != health.end_reason ||
         published->steps_taken != health.steps_taken;
}

bool starts(const messages::CommandAcknowledgement& acknowledgement) {
  return acknowledgement.order == messages::Order::kStart && messages::was_obeyed(acknowledgement.outcome);
}

}  // namespace

CanPort::CanPort(std::uint8_t index, const host::PortSettings& settings, const n2k::LocalPlane& plane, const HostClock& host,
                 host::IfMissing if_missing)
    : Port(index, settings.roles),
      name_(settings.name),
      interface_(settings.address),
      software_version_(program::version().substr(0, kLongestText)),
      serial_(std::to_string(settings.n2k.unique_number)),
      host_(host),
      settings_(settings.n2k),
      command_proof_(settings.command_proof),
      pgns_sent_(pgns_sent(settings.roles)),
      pgns_read_(pgns_read(settings.roles)),
      socket_(settings.address, if_missing, {.filters = filters_of(settings.roles)}),
      was_up_(socket_.is_up()),
      node_(new_node()),
      receiver_(plane, settings.n2k.navigation),
      condition_(settings.n2k.navigation.oldest_part),
      snr_gate_(settings.n2k.snr_source),
      autopilot_gate_(settings.n2k.autopilot_source),
      watch_(settings.roles, settings.n2k.navigation.oldest_part) {}

n2k::Node CanPort::new_node() const {
  // The mission file's ranges are those of the NAME's parts.
  const n2k::Name name = n2k::name_of({.unique_number = settings_.unique_number, .device_instance = settings_.device_instance}).value();
  const n2k::Identity identity{.name = name,
                               .preferred_address = settings_.address,
                               .product = {.software_version = software_version_, .serial = serial_},
                               .configuration = {}};
  return {identity, pgns_sent_.span(), pgns_read_.span()};
}

void CanPort::serve() {
  // What the bus knew of us before it went down it may have forgotten, and given to others.
  if (socket_.is_up() && !was_up_) node_ = new_node();
  was_up_ = socket_.is_up();
  if (was_up_) {
    n2k::NodeFrames frames;
    node_.set_controller_state(socket_.controller_state());
    node_.step(host_now(), frames);
    for (std::span<const n2k::Frame> rest = frames.span(); !rest.empty();) {
      const std::size_t whole = frames_together(rest);
      (void)send(rest.first(whole));
      rest = rest.subspan(whole);
    }
  }
  socket_.flush(host_now());
}

bool CanPort::settle() {
  if (!socket_.is_up()) return true;
  std::size_t budget = config::kCanFramesPerCollect;
  Time received_utc;
  messages::Navigation unused;
  for (n2k::Frame frame; socket_.receive(frame, received_utc, budget) == Status::kOk;) {
    const n2k::HeardFrame heard(frame);
    node_.accept(heard, host_now());
    const Result<n2k::Identifier>& identifier = heard.identifier;
    if (identifier.ok() && identifier.value().pgn == n2k::kAddressClaimPgn) (void)receiver_.accept(heard, Time{}, unused);
  }
  serve();
  return node_.address().has_value();
}

void CanPort::collect(Clock& clock, InputSink& sink) {
  std::size_t budget = config::kCanFramesPerCollect;
  const Time now = host_now();
  Time received_utc;
  for (n2k::Frame frame; socket_.receive(frame, received_utc, budget) == Status::kOk;) {
    const n2k::HeardFrame heard(frame);
    node_.accept(heard, now);
    if (received_utc < Time{}) received_utc = host_.utc();  // the kernel does not say
    take(heard, {.utc = received_utc, .mission = clock.arrival_of(received_utc)}, clock, sink);
  }
  report_vehicle_status(clock.now(), sink);
  report_troubles(clock.now(), sink);
}

void CanPort::take(const n2k::HeardFrame& heard, const Arrival& arrival, Clock& clock, InputSink& sink) {
  if (!heard.identifier.ok()) return;
  switch (heard.identifier.value().pgn) {
    case n2k::kPeerPgn:
      if (has(host::Role::kOperator)) take_order(heard, arrival, clock, sink);
      return;
    case n2k::kSnrPgn:
      if (has(host::Role::kSnr)) take_snr(heard, arrival, sink);
      return;
    case n2k::kLeakPgn:
      if (has(host::Role::kNavigation)) take_hull(heard, arrival);
      return;
    case n2k::kAutopilotStatusPgn:
      if (has(host::Role::kAutopilot)) take_autopilot_status(heard, arrival, sink);
      return;
    case n2k::kAddressClaimPgn:  // the SNR's device may be known by its NAME, too
      return take_navigation(heard, arrival, sink);
    default:
      if (has(host::Role::kNavigation)) take_navigation(heard, arrival, sink);
  }
}

void CanPort::take_navigation(const n2k::HeardFrame& heard, const Arrival& arrival, InputSink& sink) {
  messages::Navigation fix;
  if (receiver_.accept(heard, arrival.mission, fix) != Status::kOk) return;
  ++fixes_;
  ++report_.received;
  sink.take(index(), fix);
}

void CanPort::take_snr(const n2k::HeardFrame& heard, const Arrival& arrival, InputSink& sink) {
  const n2k::Identifier& identifier = heard.identifier.value();
  const Result<n2k::HeardSnr> condition = n2k::read_snr(heard.frame.bytes());
  const Result<bool> deaf = n2k::read_deaf(heard.frame.bytes());
  note_refusal(condition.ok() || condition.status() == Status::kNotReady ? deaf.status() : condition.status());
  if (!condition.ok() && !deaf.ok()) return;
  const n2k::Origin origin{.pgn = identifier.pgn, .address = identifier.source, .instance = {}};
  const n2k::Directory& directory = receiver_.sensors().directory();
  const n2k::SourceStatus source_status = snr_gate_.status_of(origin, directory, arrival.mission, n2k::table::kSnr.handover);
  if (source_status == n2k::SourceStatus::kNotChosen && condition.ok()) ++snr_not_chosen_;
  if (source_status == n2k::SourceStatus::kNotChosen || source_status == n2k::SourceStatus::kHeldByAnother) return;
  report_hearing(deaf, condition.ok(), origin.address, arrival, sink);
  if (!condition.ok()) return;
  snr_gate_.hold(origin, directory, arrival.mission);
  ++measurements_;
  ++report_.received;
  sink.take(index(), n2k::measurement_of(condition.value(), arrival.mission));
}

/// Of the hydrophone that the SNR is taken from. Once another is, which does not say of itself, the deafness of the one before is over.
void CanPort::report_hearing(const Result<bool>& deaf, bool has_snr, std::uint8_t source, const Arrival& arrival, InputSink& sink) {
  const bool is_replaced = has_snr && deaf_address_ && *deaf_address_ != source;
  if (!deaf.ok() && !is_replaced) return;
  const bool is_deaf = deaf.ok() && deaf.value();
  deaf_address_ = is_deaf ? std::optional(source) : std::nullopt;
  sink.take(index(), messages::HydrophoneStatus{.time = arrival.mission, .is_deaf = is_deaf});
}

void CanPort::take_hull(const n2k::HeardFrame& heard, const Arrival& arrival) {
  note_refusal(condition_.accept_hull(heard, receiver_.sensors().directory(), arrival.mission));
}

/// Given at the end of a reading, so that a status holds all that has come.
void CanPort::report_vehicle_status(Time now, InputSink& sink) {
  messages::VehicleStatus status;
  if (condition_.give(receiver_.sensors(), now, status) != Status::kOk) return;
  ++report_.received;
  sink.take(index(), status);
}

void CanPort::take_autopilot_status(const n2k::HeardFrame& heard, const Arrival& arrival, InputSink& sink) {
  const n2k::Identifier& identifier = heard.identifier.value();
  const Result<n2k::AutopilotCondition> condition = n2k::read_autopilot_status(heard.frame.bytes());
  note_refusal(condition.status());
  if (!condition.ok()) return;
  const n2k::Origin origin{.pgn = identifier.pgn, .address = identifier.source, .instance = {}};
  const n2k::Directory& directory = receiver_.sensors().directory();
  const n2k::SourceStatus source_status =
      autopilot_gate_.status_of(origin, directory, arrival.mission, n2k::table::kAutopilotStatus.handover);
  if (source_status == n2k::SourceStatus::kNotChosen || source_status == n2k::SourceStatus::kHeldByAnother) return;
  autopilot_gate_.hold(origin, directory, arrival.mission);
  ++report_.received;
  sink.take(index(), messages::AutopilotStatus{.time = arrival.mission, .follows_setpoints = condition.value().follows_setpoints});
}

/// Another maker's message is none, nor is a device's that says it has no value.
void CanPort::note_refusal(Status status) {
  if (status != Status::kOk && status != Status::kUnsupported && status != Status::kNotReady) ++own_refused_;
}

std::uint64_t CanPort::publish(Time now, const runtime::Outputs& outputs) {
  zero_pressure(now, outputs);
  unreadable_answered_ = 0;
  std::uint64_t setpoints = 0;
  if (has(host::Role::kAutopilot) && outputs.setpoint) {
    const auto compose = [&](std::uint8_t address, n2k::SetpointFrames& frames) {
      return n2k::compose_setpoint(*outputs.setpoint, address, sequences_.setpoint++, frames);
    };
    if (send_composed<n2k::SetpointFrames>(compose, {.kept = host::WhileWaiting::kKeepNewest})) ++setpoints;
  }
  if (has(host::Role::kOperator)) {
    acknowledge(outputs);
    publish_challenge(now);
  }
  if (has(host::Role::kStatus)) publish_status(now, outputs);
  return setpoints;
}

void CanPort::publish_status(Time now, const runtime::Outputs& outputs) {
  if (outputs.decision) {
    send_composed<n2k::FastPacketFrames>([&](std::uint8_t address, n2k::FastPacketFrames& frames) {
      return n2k::compose_decision(*outputs.decision, {.source = address, .sequence = sequences_.decision++}, frames);
    });
  }
  if (!is_new(published_health_, outputs.health) && now - published_at_ < kStatusPeriod) return;
  published_health_ = outputs.health;
  published_at_ = now;
  send_composed<n2k::FastPacketFrames>([&](std::uint8_t address, n2k::FastPacketFrames& frames) {
    return n2k::compose_health(outputs.health, now, {.source = address, .sequence = sequences_.health++}, frames);
  });
  for (const messages::PortReport& port : outputs.health.ports) {
    send_composed<n2k::FastPacketFrames>([&](std::uint8_t address, n2k::FastPacketFrames& frames) {
      return n2k::compose_port_health(port, {.source = address, .sequence = sequences_.port_health++}, frames);
    });
  }
}

/// Once, with the START that is obeyed: whoever gives it sees where the vehicle is, and it has not moved by our word yet. Deeper than a
/// pressure at the surface can mean, nothing is zeroed.
void CanPort::zero_pressure(Time now, const runtime::Outputs& outputs) {
  const bool was_standing_by = state_ == messages::MissionState::kStandby;
  state_ = outputs.health.state;
  if (!settings_.zero_pressure_at_surface || is_zeroed_ || !was_standing_by) return;
  if (std::ranges::any_of(outputs.acknowledgements, starts)) zero_is_due_ = true;
  if (!zero_is_due_ || !n2k::is_fresh(receiver_.sensors().readings().pressure_pa, now, settings_.navigation.oldest_part)) return;
  is_zeroed_ = receiver_.zero_at_surface() == Status::kOk;
  zero_is_due_ = false;
}

/// @return false: it is not sent, and never will be. What waits for room is sent, or counted by the socket.
bool CanPort::send(std::span<const n2k::Frame> frames, const host::Waiting& waiting) {
  if (!socket_.is_up()) return false;
  const Status status = socket_.send_whole(frames, host_now(), waiting);
  return status == Status::kOk || status == Status::kNotReady;
}

messages::PortReport CanPort::report() const {
  messages::PortReport report = report_;
  const host::CanCounters can = socket_.counters();
  report.link_up = socket_.is_up();
  report.lost += can.lost_by_kernel + can.controller.overflows;
  report.malformed += receiver_.counters().malformed + orders_.counters().refused + own_refused_;
  report.unsent += can.groups.replaced + can.groups.expired + can.groups.abandoned + can.groups.shed;
  return report;
}

BusSigns CanPort::signs() const {
  const messages::PortReport now = report();
  const n2k::SensorCounters& sensors = receiver_.sensors().counters();
  const auto not_chosen = [&](n2k::Measured measured) { return sensors.not_chosen[static_cast<std::size_t>(measured)]; };
  return {.has_address = node_.address().has_value(),
          .own_name_claims = node_.claim_counters().own,
          .controller = socket_.controller_state(),
          .frames_lost = now.lost,
          .unsent = now.unsent - without_address_,
          .fixes = fixes_,
          .measurements = measurements_,
          .no_variation = sensors.no_variation,
          .not_chosen = {.position = not_chosen(n2k::Measured::kPosition),
                         .heading = not_chosen(n2k::Measured::kHeading),
                         .pressure = not_chosen(n2k::Measured::kPressure),
                         .snr = snr_not_chosen_},
          .readings = receiver_.sensors().readings()};
}

void CanPort::report_troubles(Time mission_now, InputSink& sink) {
  // Of a missing interface the link's own line tells; a controller that has left the bus says so here.
  const bool sees_bus = socket_.is_up() || socket_.controller_state() == n2k::ControllerState::kBusOff;
  const TroubleWatch::Now now{.host = host_now(), .mission = mission_now};
  if (sees_bus && !saw_bus_) watch_.restart(signs(), now);
  saw_bus_ = sees_bus;
  if (!sees_bus) return;
  const BusTroubles troubles = watch_.check(signs(), now);
  const BusTroubles changed = troubles ^ reported_troubles_;
  for (std::size_t i = 0; i < kBusTroubleCount; ++i) {
    if (changed[i]) sink.report_trouble(index(), static_cast<BusTrouble>(i), troubles[i]);
  }
  reported_troubles_ = troubles;
  met_troubles_ |= troubles;
}

std::string CanPort::remark() const {
  const messages::PortReport counts = report();
  const host::CanCounters can = socket_.counters();
  std::string text;
  const auto add = [&text](std::uint64_t count, const std::string& what) {
    if (count > 0) text += (text.empty() ? "" : "; ") + std::to_string(count) + what;
  };
  add(counts.lost,
      " frames lost on their way in, because they came faster than they were read and the socket's or the controller's buffer was full: "
      "lighten the bus, or raise sysctl net.core.rmem_max");
  add(counts.unsent - without_address_,
      " messages could not be sent, because the interface was down or nobody on the bus took its frames: check its state (ip -d -s "
      "link)");
  add(without_address_, " messages could not be sent, because there was no address on the bus: devices with more rights had it");
  add(can.controller.bus_off,
      " times the controller left the bus after too many errors: check the cables, their two ends and the bit rate");
  // A few positions come before the first heading and the first pressure on every voyage.
  if ((met_troubles_ & kPartsMissing).any())
    add(receiver_.counters().waiting,
        " positions made no fix, because heading or pressure was missing or older than oldest_part_s: check how often their devices "
        "send");
  if (met_troubles_[static_cast<std::size_t>(BusTrouble::kSameName)])
    text += (text.empty() ? "" : "; ") + std::string(begin_of(BusTrouble::kSameName));
  return text.empty() ? text : label() + ": " + text;
}

}  // namespace earshot::board
