#include "sim/link/runtime_end.hpp"

#include <thread>

#include "sim.h"
#include "sim/link/dds_entities.hpp"

namespace earshot::link {
namespace {

messages::Bearing bearing_of(const earshot_sim_Tick& sample) {
  return {.direction = Radians{sample.bearing_rad},
          .deviation = Radians{sample.bearing_deviation_rad},
          .mirror_axis = sample.bearing_ambiguous ? std::optional(Radians{sample.bearing_axis_rad}) : std::nullopt};
}

Tick from_wire(const earshot_sim_Tick& sample) {
  return {.number = sample.number,
          .time = {sample.time_us},
          .navigation_messages = sample.navigation_messages,
          .hydrophone_blocks = sample.hydrophone_blocks,
          .snr = sample.snr_valid ? std::optional(Decibels{sample.snr_db}) : std::nullopt,
          .snr_too_faint = sample.snr_too_faint,
          .bearing = sample.bearing_valid ? std::optional(bearing_of(sample)) : std::nullopt,
          .command = sample.command,
          .battery_percent = sample.battery_valid ? std::optional(sample.battery_percent) : std::nullopt};
}

earshot_sim_Answer to_wire(const Answer& answer, RunId run) {
  const messages::SafetyEvent rule = answer.rule.value_or(messages::SafetyEvent{});
  return {.run = run,
          .number = answer.number,
          .turns_made = answer.turns_made,
          .setpoint_messages = answer.setpoint_messages,
          .steps_taken = answer.steps_taken,
          .state = answer.state,
          .end_reason = answer.end_reason,
          .source_believed = answer.believed_source.has_value(),
          .source_north_m = answer.believed_source.value_or(NorthEast{}).north.value,
          .source_east_m = answer.believed_source.value_or(NorthEast{}).east.value,
          .surprise_bits = answer.mismatch_bits,
          .sweeping = answer.is_sweeping,
          .found = answer.is_found,
          .rule_acted = answer.rule.has_value(),
          .rule = rule.rule,
          .rule_condition = static_cast<std::uint8_t>(rule.condition),
          .rule_response = static_cast<std::uint8_t>(rule.response),
          .rule_measure = rule.measure,
          .rule_limit = rule.limit};
}

}  // namespace

struct RuntimeEnd::Entities {
  Entities(std::uint32_t domain, RunId run) : session(domain), delivering(session, earshot_sim_Tick_desc, ticks, run) {}

  Mailbox<Tick> ticks;  // outlives the session, whose threads fill it
  Mailbox<Answer> outbox;
  Session session;
  dds_entity_t answers = make_writer(session, earshot_sim_Answer_desc);
  Delivering<earshot_sim_Tick, Tick, from_wire> delivering;
  std::thread answering{[this] { write_answers(); }};

  void write_answers() {
    constexpr std::chrono::milliseconds kPollInterval{2000};
    Answer answer;
    for (;;) {
      const Delivery delivery = outbox.take(answer, kPollInterval);
      if (delivery == Delivery::kLost) return;
      if (delivery == Delivery::kNothing) continue;
      const earshot_sim_Answer sample = to_wire(answer, delivering.run());
      dds_write(answers, &sample);  // a failure shows as the simulator not advancing
    }
  }
};

RuntimeEnd::RuntimeEnd(std::uint32_t domain, RunId run) : entities_(std::make_unique<Entities>(domain, run)) {}

RuntimeEnd::~RuntimeEnd() {
  entities_->outbox.close();
  entities_->answering.join();
}

bool RuntimeEnd::wait_for_simulator(std::chrono::milliseconds timeout) {
  Tick knock;
  return entities_->ticks.take(knock, timeout) == Delivery::kArrived;
}

Delivery RuntimeEnd::receive(Tick& tick, std::chrono::milliseconds timeout) {
  for (;;) {
    const Delivery delivery = entities_->ticks.take(tick, timeout);
    if (delivery != Delivery::kArrived || tick.number != 0) return delivery;
    send({.turns_made = turns_made_});
  }
}

std::uint64_t RuntimeEnd::strangers() const {
  return entities_->delivering.strangers();
}

void RuntimeEnd::send(const Answer& answer) {
  entities_->outbox.put(answer);
}

}  // namespace earshot::link
