#include "firmware/boards/linux/port/port_set.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

#include "firmware/host/file/printable.hpp"

namespace earshot::board {
namespace {

std::string line_of(const Port& port) {
  return "  port " + std::to_string(port.index()) + ": " + port.words().description() + "\n";
}

/// @param report  whose port and link it is
messages::PortReport summed(messages::PortReport report, const messages::PortReport& other) {
  report.received += other.received;
  report.lost += other.lost;
  report.malformed += other.malformed;
  report.unsent += other.unsent;
  return report;
}

}  // namespace

void PortSet::add(std::unique_ptr<Port> port) {
  if (ports_.size() + 1 >= config::kMaxPorts) throw std::invalid_argument("more than " + std::to_string(config::kMaxPorts - 1) + " ports");
  ports_.push_back(std::move(port));
  const FurtherDuties duties = ports_.back()->further_duties();
  if (duties.bus_member != nullptr) bus_members_.push_back(duties.bus_member);
  if (duties.sound_listener != nullptr) sound_listeners_.push_back(duties.sound_listener);
  if (duties.detection_sender != nullptr) detection_senders_.push_back(duties.detection_sender);
}

void PortSet::collect(Clock& clock, InputSink& sink) {
  for (const auto& port : ports_) port->collect(clock, sink);
}

void PortSet::publish(Time now, const runtime::Outputs& outputs) {
  for (const auto& port : ports_) setpoints_sent_ += port->publish(now, outputs);
}

void PortSet::publish_detection(const messages::SoundDetection& detection) {
  for (DetectionSender* const sender : detection_senders_) sender->publish_detection(detection);
}

void PortSet::note_speed(MetersPerSecond speed) {
  for (SoundListener* const listener : sound_listeners_) listener->note_speed(speed);
}

void PortSet::report_changes(InputSink& sink) {
  for (const auto& port : ports_) {
    const messages::PortReport report = summed(port->report(), before_[port->index()]);
    messages::PortReport& reported = reported_[port->index()];
    if (report == reported) continue;
    reported = report;
    sink.take(port->index(), report);
  }
}

void PortSet::count_on_from(const std::array<messages::PortReport, config::kMaxPorts>& reported) {
  before_ = reported_ = reported;
}

void PortSet::serve() {
  for (BusMember* const member : bus_members_) member->serve();
}

void PortSet::settle(std::chrono::milliseconds most) {
  constexpr Duration kPollInterval = Duration::milliseconds(10);
  for (const auto deadline = std::chrono::steady_clock::now() + most; std::chrono::steady_clock::now() < deadline;) {
    // Every member is asked every time: one that waits for an address must go on claiming it beside another.
    const auto unsettled = std::ranges::count_if(bus_members_, [](BusMember* member) { return !member->settle(); });
    if (unsettled == 0) return;
    wait_for_ports({}, kPollInterval);
  }
}

void PortSet::tend() {
  const auto now = std::chrono::steady_clock::now();
  if (now - last_tended_ < std::chrono::seconds(1)) return;
  last_tended_ = now;
  for (const auto& port : ports_) port->tend();
}

std::span<const pollfd> PortSet::readable() {
  std::size_t count = 0;
  for (const auto& port : ports_) {
    if (port->file_descriptor() >= 0) readable_[count++] = {.fd = port->file_descriptor(), .events = POLLIN, .revents = 0};
  }
  return std::span(readable_).first(count);
}

bool PortSet::carries_setpoints() const {
  return std::ranges::any_of(ports_, [](const auto& port) { return port->has(host::Role::kAutopilot); });
}

std::uint64_t PortSet::blocks_heard() const {
  std::uint64_t sum = 0;
  for (const SoundListener* const listener : sound_listeners_) sum += listener->blocks_heard();
  return sum;
}

std::string PortSet::description() const {
  std::string text;
  for (const auto& port : ports_) text += line_of(*port);
  return text;
}

std::string PortSet::down() const {
  std::string text;
  for (const auto& port : ports_) {
    if (!port->report().link_up) text += line_of(*port);
  }
  return text;
}

std::vector<PortSet::Link> PortSet::links() const {
  std::vector<Link> links;
  for (const auto& port : ports_) {
    links.push_back({.port = port->index(),
                     .label = "port " + std::to_string(port->index()) + ", " + host::printable(port->words().label),
                     .is_up = port->report().link_up});
  }
  return links;
}

std::vector<PortSet::Held> PortSet::memory() const {
  std::vector<Held> held;
  for (const auto& port : ports_)
    held.push_back({.port = std::to_string(port->index()) + ", " + port->words().description(), .bytes = port->memory()});
  return held;
}

std::vector<std::string> PortSet::remarks() const {
  std::vector<std::string> remarks;
  for (const auto& port : ports_) {
    if (std::string remark = port->words().remark; !remark.empty()) remarks.push_back(std::move(remark));
  }
  return remarks;
}

std::vector<std::string> PortSet::strangers() const {
  std::vector<std::string> strangers;
  for (const auto& port : ports_) {
    if (std::string met = port->words().strangers; !met.empty()) strangers.push_back(std::move(met));
  }
  return strangers;
}

messages::PortReport PortSet::sum() const {
  messages::PortReport sum;
  for (const auto& port : ports_) {
    if (port->has(host::Role::kHydrophone)) continue;
    const messages::PortReport report = port->report();
    const bool link_up = sum.link_up && report.link_up;
    sum = summed(sum, report);
    sum.link_up = link_up;
  }
  return sum;
}

}  // namespace earshot::board
