#include "firmware/boards/linux/can/can_port.hpp"

#include <algorithm>
#include <cstddef>

#include "firmware/host/program/version.hpp"
#include "firmware/wire/n2k/identifier.hpp"
#include "firmware/wire/n2k/own/measurements.hpp"
#include "firmware/wire/n2k/own/reports.hpp"

namespace earshot::board {
namespace {

constexpr std::size_t kLongestText = 32;  ///< of product information

/// Between two reports of an unchanged state, at least: the table's period, less what turns of one second are apart from a second.
constexpr Duration kStatusPeriod{n2k::table::kHealth.period.us * 9 / 10};

bool is_news(const std::optional<messages::Health>& told, const messages::Health& health) {
  return !told || told->state != health.state || told->end_reason != health.end_reason || told->steps_taken != health.steps_taken;
}

bool starts(const messages::CommandAcknowledgement& acknowledgement) {
  return acknowledgement.order == messages::Order::kStart && acknowledgement.outcome == messages::CommandOutcome::kObeyed;
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
      pgns_sent_(pgns_sent(settings.roles)),
      pgns_read_(pgns_read(settings.roles)),
      socket_(settings.address, if_missing),
      node_(new_node()),
      receiver_(plane, settings.n2k.navigation),
      snr_gate_(settings.n2k.snr_source) {}

n2k::Node CanPort::new_node() const {
  // The mission file's ranges are those of the NAME's parts.
  const n2k::Name name = n2k::name_of({.unique_number = settings_.unique_number, .device_instance = settings_.device_instance}).value();
  const n2k::Identity identity{.name = name,
                               .preferred_address = settings_.address,
                               .product = {.software_version = software_version_, .serial = serial_},
                               .configuration = {}};
  return {identity, pgns_sent_.span(), pgns_read_.span()};
}

void CanPort::tend() {
  // What the bus knew of us before it went down it may have forgotten.
  if (!socket_.is_up() && socket_.reopen()) node_ = new_node();
}

void CanPort::serve() {
  if (!socket_.is_up()) return;
  n2k::NodeFrames frames;
  node_.step(host_now(), frames);
  for (const n2k::Frame& frame : frames) (void)send({&frame, 1});
}

bool CanPort::settle() {
  if (!socket_.is_up()) return true;
  std::size_t budget = config::kCanFramesPerCollect;
  Time received_utc;
  messages::Navigation unused;
  for (n2k::Frame frame; socket_.receive(frame, received_utc, budget) == Status::kOk;) {
    node_.accept(frame, host_now());
    const Result<n2k::Identifier> identifier = n2k::parse_identifier(frame.identifier);
    if (identifier.ok() && identifier.value().pgn == n2k::kAddressClaimPgn) (void)receiver_.accept(frame, Time{}, unused);
  }
  serve();
  return node_.address().has_value();
}

void CanPort::collect(Clock& clock, InputSink& sink) {
  std::size_t budget = config::kCanFramesPerCollect;
  const Time now = host_now();
  Time received_utc;
  for (n2k::Frame frame; socket_.receive(frame, received_utc, budget) == Status::kOk;) {
    node_.accept(frame, now);
    take(frame, {.utc = received_utc, .mission = clock.arrival_of(received_utc)}, clock, sink);
  }
}

void CanPort::take(const n2k::Frame& frame, const Arrival& arrival, Clock& clock, InputSink& sink) {
  const Result<n2k::Identifier> identifier = n2k::parse_identifier(frame.identifier);
  if (!identifier.ok()) return;
  switch (identifier.value().pgn) {
    case n2k::kPeerPgn:
      if (has(host::Role::kOperator)) take_order(frame, arrival, clock, sink);
      return;
    case n2k::kSnrPgn:
      if (has(host::Role::kSnr)) take_snr(frame, identifier.value(), arrival, sink);
      return;
    case n2k::kAddressClaimPgn:  // the SNR's device may be known by its NAME, too
      return take_navigation(frame, arrival, sink);
    default:
      if (has(host::Role::kNavigation)) take_navigation(frame, arrival, sink);
  }
}

void CanPort::take_navigation(const n2k::Frame& frame, const Arrival& arrival, InputSink& sink) {
  messages::Navigation fix;
  if (receiver_.accept(frame, arrival.mission, fix) != Status::kOk) return;
  ++report_.received;
  sink.take(index(), fix);
}

void CanPort::take_snr(const n2k::Frame& frame, const n2k::Identifier& identifier, const Arrival& arrival, InputSink& sink) {
  const Result<n2k::HeardSnr> heard = n2k::read_snr(frame.bytes());
  if (!heard.ok()) {
    // Another maker's message, or a hydrophone that says it has no value.
    if (heard.status() != Status::kUnsupported && heard.status() != Status::kNotReady) ++snr_refused_;
    return;
  }
  const n2k::Origin origin{.pgn = identifier.pgn, .address = identifier.source, .instance = {}};
  if (!snr_gate_.admits(origin, receiver_.sensors().directory(), arrival.mission, n2k::table::kSnr.timeout)) return;
  ++report_.received;
  sink.take(index(), n2k::measurement_of(heard.value(), arrival.mission));
}

void CanPort::take_order(const n2k::Frame& frame, const Arrival& arrival, Clock& clock, InputSink& sink) {
  messages::OperatorCommand command;
  std::uint8_t sender = n2k::kNullAddress;
  // Without an address only what is meant for all is for us.
  if (orders_.accept(frame, arrival.utc, node_.address().value_or(n2k::kNullAddress), command, sender) != Status::kOk) return;
  command.time = clock.mission_time_of(command.time);
  command.expiry = clock.mission_time_of(command.expiry);
  ++report_.received;
  static_cast<void>(askers_.push_back({.issuer = command.issuer, .number = command.number, .address = sender}));
  sink.take(index(), command);
}

template <class Frames, class Compose>
bool CanPort::say(Compose compose) {
  Frames frames;
  const std::optional<std::uint8_t> address = node_.address();
  if (address && compose(*address, frames) == Status::kOk && send(frames.span())) return true;
  ++report_.unsent;
  return false;
}

std::uint64_t CanPort::publish(Time now, const runtime::Outputs& outputs) {
  zero_pressure(now, outputs);
  std::uint64_t setpoints = 0;
  if (has(host::Role::kAutopilot) && outputs.setpoint) {
    const bool is_sent = say<n2k::SetpointFrames>([&](std::uint8_t address, n2k::SetpointFrames& frames) {
      return n2k::compose_setpoint(*outputs.setpoint, address, sequences_.setpoint++, frames);
    });
    ++(is_sent ? setpoints : setpoints_unsent_);
  }
  if (has(host::Role::kOperator)) acknowledge(outputs);
  if (has(host::Role::kStatus)) tell_status(now, outputs);
  return setpoints;
}

/// Orders are judged as they come, so that an acknowledgement for each has come in the same order; of those that found no room there is
/// none.
void CanPort::acknowledge(const runtime::Outputs& outputs) {
  std::size_t next = 0;
  for (const messages::CommandAcknowledgement& acknowledgement : outputs.acknowledgements) {
    if (acknowledgement.port != index()) continue;
    const auto is_asker = [&](const Asker& asker) {
      return asker.issuer == acknowledgement.issuer && asker.number == acknowledgement.number;
    };
    const auto asker = std::find_if(askers_.begin() + next, askers_.end(), is_asker);
    if (asker == askers_.end()) continue;
    next = static_cast<std::size_t>(asker - askers_.begin()) + 1;
    say<n2k::FastPacketFrames>([&](std::uint8_t address, n2k::FastPacketFrames& frames) {
      const n2k::Route route{.source = address, .destination = asker->address, .sequence = sequences_.acknowledgement++};
      return n2k::compose_acknowledgement(acknowledgement, route, frames);
    });
  }
  askers_.clear();
}

void CanPort::tell_status(Time now, const runtime::Outputs& outputs) {
  if (outputs.decision) {
    say<n2k::FastPacketFrames>([&](std::uint8_t address, n2k::FastPacketFrames& frames) {
      return n2k::compose_decision(*outputs.decision, {.source = address, .sequence = sequences_.decision++}, frames);
    });
  }
  if (!is_news(told_, outputs.health) && now - told_at_ < kStatusPeriod) return;
  told_ = outputs.health;
  told_at_ = now;
  say<n2k::FastPacketFrames>([&](std::uint8_t address, n2k::FastPacketFrames& frames) {
    return n2k::compose_health(outputs.health, now, {.source = address, .sequence = sequences_.health++}, frames);
  });
  for (const messages::PortReport& port : outputs.health.ports) {
    say<n2k::FastPacketFrames>([&](std::uint8_t address, n2k::FastPacketFrames& frames) {
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

bool CanPort::send(std::span<const n2k::Frame> frames) {
  return std::ranges::all_of(frames, [this](const n2k::Frame& frame) { return socket_.send(frame) == Status::kOk; });
}

messages::PortReport CanPort::report() const {
  messages::PortReport report = report_;
  report.link_up = socket_.is_up();
  report.lost += socket_.counters().lost_by_kernel;
  report.malformed += receiver_.counters().refused + orders_.counters().refused + snr_refused_;
  return report;
}

std::string CanPort::remark() const {
  const std::uint64_t lost = socket_.counters().lost_by_kernel;
  std::string text;
  const auto add = [&text](std::uint64_t count, const std::string& what) {
    if (count > 0) text += (text.empty() ? "" : "; ") + std::to_string(count) + what;
  };
  add(lost,
      " frames lost on their way in, because they came faster than they were read and the socket's buffer was full: lighten the bus, or "
      "raise sysctl net.core.rmem_default");
  add(setpoints_unsent_,
      " set-points could not be sent, because the interface was down or nobody on the bus took its frames: look at its state (ip -d -s "
      "link)");
  return text.empty() ? text : label() + ": " + text;
}

}  // namespace earshot::board
