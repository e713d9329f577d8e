#include "firmware/boards/linux/can_port.hpp"

#include <cstdint>
#include <string>

#include "firmware/config/capacities.hpp"
#include "firmware/wire/n2k/identifier.hpp"

namespace earshot::board {

CanPort::CanPort(std::uint8_t index, const host::PortSettings& settings, const n2k::LocalPlane& plane, host::IfMissing if_missing)
    : Port(index, settings.roles),
      name_(settings.name),
      interface_(settings.address),
      socket_(settings.address, if_missing),
      receiver_(plane) {}

void CanPort::collect(Clock& clock, InputSink& sink) {
  std::size_t budget = config::kCanFramesPerCollect;
  Time received_utc;
  for (n2k::Frame frame; socket_.receive(frame, received_utc, budget) == Status::kOk;) {
    messages::Navigation fix;
    if (!has(host::Role::kNavigation) || receiver_.accept(frame, clock.arrival_of(received_utc), fix) != Status::kOk) continue;
    ++report_.received;
    sink.take(index(), fix);
  }
}

std::uint64_t CanPort::publish(Time /*now*/, const runtime::Outputs& outputs) {
  if (!has(host::Role::kAutopilot) || !outputs.setpoint) return 0;
  if (send(*outputs.setpoint) == Status::kOk) return 1;
  ++report_.unsent;
  return 0;
}

Status CanPort::send(const messages::Setpoint& setpoint) {
  n2k::SetpointFrames frames;
  const Status composed = n2k::compose_setpoint(setpoint, n2k::kRuntimeAddress, sequence_++, frames);
  if (composed != Status::kOk) return composed;
  for (const n2k::Frame& frame : frames) {
    const Status sent = socket_.send(frame);
    if (sent != Status::kOk) return sent;
  }
  return Status::kOk;
}

messages::PortReport CanPort::report() const {
  messages::PortReport report = report_;
  report.link_up = socket_.is_up();
  report.lost += socket_.counters().lost_by_kernel;
  report.malformed += receiver_.counters().refused;
  return report;
}

std::string CanPort::remark() const {
  const std::uint64_t lost = socket_.counters().lost_by_kernel;
  std::string text;
  if (lost > 0) {
    text =
        std::to_string(lost) +
        " frames lost on their way in, because they came faster than they were read and the socket's buffer was full: lighten the bus, or "
        "raise sysctl net.core.rmem_default";
  }
  if (report_.unsent > 0) {
    text +=
        (text.empty() ? "" : "; ") + std::to_string(report_.unsent) +
        " set-points could not be sent, because the interface was down or nobody on the bus took its frames: look at its state (ip -d -s "
        "link)";
  }
  return text.empty() ? text : label() + ": " + text;
}

}  // namespace earshot::board
