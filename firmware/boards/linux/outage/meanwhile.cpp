#include "firmware/boards/linux/outage/meanwhile.hpp"

#include <chrono>
#include <variant>

#include "firmware/config/safety.hpp"

namespace earshot::board {
namespace {

/// With slow disks.
constexpr std::chrono::milliseconds kPatience{100};

}  // namespace

void Meanwhile::take(std::uint8_t port, const Value& value) {
  const auto* const command = std::get_if<messages::OperatorCommand>(&value);
  const Time now = clock_.now();
  if (mission_ != nullptr) {
    mission_->take(port, value);
    if (!std::holds_alternative<messages::Navigation>(value)) return;
  }
  if (command == nullptr) {
    (void)core_.take({.arrival = now, .port = port, .sequence = 0, .value = value});
  } else if (command->order == messages::Order::kAbort) {
    // Where there is no room its sender asks again.
    static_cast<void>(acknowledgements_.push_back({.time = now,
                                                   .port = port,
                                                   .issuer = command->issuer,
                                                   .number = command->number,
                                                   .order = command->order,
                                                   .outcome = obey(port, *command)}));
  }
}

messages::CommandOutcome Meanwhile::obey(std::uint8_t port, const messages::OperatorCommand& command) {
  using messages::CommandOutcome;
  if (abort_ || before_.state == messages::MissionState::kAbort) return CommandOutcome::kRepeated;
  abort_ = {port, command};
  return safety_.abort(kPatience) ? CommandOutcome::kObeyed : CommandOutcome::kObeyedNotDurable;
}

void Meanwhile::report_detection(std::uint8_t port, const messages::SoundDetection& detection) {
  if (mission_ != nullptr) mission_->report_detection(port, detection);
}

void Meanwhile::report_chain(std::uint8_t port, const HeardChain& chain) {
  if (mission_ != nullptr) mission_->report_chain(port, chain);
}

void Meanwhile::report_trouble(std::uint8_t port, BusTrouble trouble, bool is_there) {
  if (mission_ != nullptr) mission_->report_trouble(port, trouble, is_there);
}

void Meanwhile::report_order_trouble(std::uint8_t port, OrderTrouble trouble) {
  if (mission_ != nullptr) mission_->report_order_trouble(port, trouble);
}

void Meanwhile::turn() {
  ports_.collect(clock_, *this);
  ports_.serve();
  ports_.tend();
  publish_state();
}

void Meanwhile::publish_state() {
  const Time now = clock_.now();
  runtime::Outputs outputs = core_.step(now);
  outputs.acknowledgements = acknowledgements_;
  acknowledgements_.clear();
  safety_.stamp(now);
  if (safety_.is_overtaken()) return;
  const host::SafetyRecord& record = safety_.record();
  if (outputs.setpoint && outputs.setpoint->release_weight && !record.is_released) (void)safety_.release(kPatience);
  outputs.health.state = record.state;
  outputs.health.end_reason = record.end_reason;
  outputs.health.is_paused = record.is_paused;
  outputs.health.response = config::Response::kSurface;
  if (record.state == messages::MissionState::kSearch)
    outputs.health.authority = record.is_engaged ? messages::Authority::kCommand : messages::Authority::kListen;
  ports_.publish(now, outputs);
}

}  // namespace earshot::board
