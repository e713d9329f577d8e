#include "firmware/boards/linux/can/status_output.hpp"

#include "firmware/wire/n2k/own/reports.hpp"
#include "firmware/wire/n2k/table/messages.hpp"

namespace earshot::board {
namespace {

/// Between two reports of an unchanged state.
constexpr Duration kStatusPeriod = least_between(n2k::table::kHealth.period);

bool is_new(const std::optional<messages::Health>& published, const messages::Health& health) {
  return !published || published->state != health.state || published->end_reason != health.end_reason ||
         published->steps_taken != health.steps_taken;
}

}  // namespace

void StatusOutput::publish(Time now, const runtime::Outputs& outputs) {
  if (outputs.decision) {
    device_.send<n2k::FastPacketFrames>([&](std::uint8_t address, n2k::FastPacketFrames& frames) {
      return n2k::compose_decision(*outputs.decision, {.source = address, .sequence = decision_sequence_++}, frames);
    });
  }
  if (!is_new(published_, outputs.health) && now - published_at_ < kStatusPeriod) return;
  published_ = outputs.health;
  published_at_ = now;
  device_.send<n2k::FastPacketFrames>([&](std::uint8_t address, n2k::FastPacketFrames& frames) {
    return n2k::compose_health(outputs.health, now, {.source = address, .sequence = health_sequence_++}, frames);
  });
  for (const messages::PortReport& port : outputs.health.ports) {
    device_.send<n2k::FastPacketFrames>([&](std::uint8_t address, n2k::FastPacketFrames& frames) {
      return n2k::compose_port_health(port, {.source = address, .sequence = port_health_sequence_++}, frames);
    });
  }
}

}  // namespace earshot::board
