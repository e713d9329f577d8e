#include "hil/nodes/vehicle_events.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "firmware/core/math.hpp"
#include "firmware/host/text/numbers.hpp"
#include "firmware/messages/dictionary/command_words.hpp"
#include "firmware/messages/dictionary/mission_words.hpp"

namespace earshot::hil {
namespace {

constexpr double kNewCourse_rad = 0.4;  ///< about 23 degrees: less is what keeps the vehicle on its leg

long whole_degrees(Radians angle) {
  const long turned = std::lround(wrap_to_pi(angle).value * 180.0 / std::numbers::pi);
  return turned < 0 ? turned + 360 : turned;
}

bool is_another_course(const vehicle::Command& a, const vehicle::Command& b) {
  return a.speed != b.speed || a.depth != b.depth || std::abs(wrap_to_pi(a.heading - b.heading).value) > kNewCourse_rad;
}

std::string decision_in_words(const messages::Decision& decision) {
  return host::formatted("step %u: at ", static_cast<unsigned>(decision.step)) + in_kilometres(decision.position) +
         (decision.too_faint ? ", nothing heard" : host::formatted(", SNR %.1f dB", decision.snr.value)) + "; on to " +
         in_kilometres(decision.waypoint);
}

}  // namespace

std::string in_kilometres(NorthEast place) {
  return host::formatted("%.2f km north, %.2f km east", place.north.value / 1e3, place.east.value / 1e3);
}

std::string on_a_watch(Duration duration) {
  const std::int64_t s = duration.us / 1'000'000;
  return host::formatted("%lld:%02lld:%02lld", static_cast<long long>(s / 3600), static_cast<long long>(s / 60 % 60),
                         static_cast<long long>(s % 60));
}

std::vector<std::string> VehicleEvents::lines(Time now) {
  std::vector<std::string> lines;
  if (const Operator* const ashore = vehicle_.operator_ashore()) report_earshot(*ashore, lines);
  if (const Autopilot* const autopilot = vehicle_.autopilot()) report_course(*autopilot, lines);
  for (std::string& line : lines) line = on_a_watch(now - began_) + "  " + line;
  return lines;
}

void VehicleEvents::report_earshot(const Operator& ashore, std::vector<std::string>& lines) {
  for (; answers_ < ashore.answers().size(); ++answers_) {
    const messages::CommandAcknowledgement& answer = ashore.answers()[answers_];
    lines.push_back("operator: " + std::string(messages::name_of(answer.order)) + ": " + std::string(messages::name_of(answer.outcome)));
  }
  if (ashore.decisions() != decisions_) {
    decisions_ = ashore.decisions();
    lines.push_back(decision_in_words(*ashore.decision()) + host::formatted(" (the source is %.2f km away)", vehicle_.range().value / 1e3));
  }
  if (!ashore.health() || ashore.health()->health.state == state_) return;
  const messages::Health& health = ashore.health()->health;
  std::string line =
      host::formatted("Earshot, address %u, is in ", static_cast<unsigned>(*ashore.vehicle())) + messages::to_string(health.state);
  if (health.end_reason != messages::EndReason::kNone) line += std::string(": ") + messages::to_string(health.end_reason);
  lines.push_back(line);
  state_ = health.state;
}

void VehicleEvents::report_course(const Autopilot& autopilot, std::vector<std::string>& lines) {
  const vehicle::Command& command = autopilot.command();
  if (autopilot.is_forsaken() && !is_forsaken_)
    lines.push_back(host::formatted("autopilot: no set-point for %.0f s: stops and comes up", kAutopilotPatience.to_seconds()));
  is_forsaken_ = autopilot.is_forsaken();
  if (autopilot.is_weight_released() && !is_weight_released_) lines.emplace_back("autopilot: releases the drop weight");
  is_weight_released_ = autopilot.is_weight_released();
  if (autopilot.taken() == 0 || is_forsaken_ || (course_ && !is_another_course(command, *course_))) return;
  course_ = command;
  lines.push_back(host::formatted("autopilot: steers %03ld degrees, %.1f m/s, %.0f m deep", whole_degrees(command.heading),
                                  command.speed.value, command.depth.value));
}

std::string VehicleEvents::summary(Time now) const {
  std::string text = host::formatted("sailed %.2f km in ", vehicle_.sailed().value / 1e3) + on_a_watch(now - began_);
  if (const Autopilot* const autopilot = vehicle_.autopilot())
    text += host::formatted(", %llu set-points taken", static_cast<unsigned long long>(autopilot->taken()));
  return text;
}

}  // namespace earshot::hil
