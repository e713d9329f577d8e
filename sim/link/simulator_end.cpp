#include "sim/link/simulator_end.hpp"

#include "sim.h"
#include "sim/link/dds_entities.hpp"

namespace earshot::link {
namespace {

/// What a rule of another version is called, whoever puts it into words says.
messages::SafetyEvent rule_in(const earshot_sim_Answer& sample) {
  return {.time = {},
          .rule = sample.rule,
          .condition = static_cast<config::Condition>(sample.rule_condition),
          .response = static_cast<config::Response>(sample.rule_response),
          .measure = sample.rule_measure,
          .limit = sample.rule_limit};
}

Answer from_wire(const earshot_sim_Answer& sample) {
  return {.number = sample.number,
          .turns_made = sample.turns_made,
          .setpoint_messages = sample.setpoint_messages,
          .steps_taken = sample.steps_taken,
          .state = sample.state,
          .end_reason = sample.end_reason,
          .believed_source =
              sample.source_believed ? std::optional(NorthEast{Meters{sample.source_north_m}, Meters{sample.source_east_m}}) : std::nullopt,
          .mismatch_bits = sample.surprise_bits,
          .is_sweeping = sample.sweeping,
          .is_found = sample.found,
          .rule = sample.rule_acted ? std::optional(rule_in(sample)) : std::nullopt};
}

}  // namespace

struct SimulatorEnd::Entities {
  Entities(std::uint32_t domain, RunId run) : session(domain), delivering(session, earshot_sim_Answer_desc, answers, run) {}

  Mailbox<Answer> answers;  // outlives the session, whose threads fill it
  Session session;
  dds_entity_t ticks = make_writer(session, earshot_sim_Tick_desc);
  dds_entity_t ground_truth = make_writer(session, earshot_sim_GroundTruth_desc);
  Delivering<earshot_sim_Answer, Answer, from_wire> delivering;
};

SimulatorEnd::SimulatorEnd(std::uint32_t domain, RunId run)
    : domain_(domain), run_(run), entities_(std::make_unique<Entities>(domain, run)) {}
SimulatorEnd::~SimulatorEnd() = default;

bool SimulatorEnd::wait_for_runtime(std::chrono::milliseconds timeout) {
  using std::chrono::steady_clock;
  constexpr std::chrono::milliseconds kBetweenKnocks{20};
  const auto deadline = steady_clock::now() + timeout;
  do {
    send({});
    Answer answer;
    const Delivery delivery = receive(answer, kBetweenKnocks);
    if (delivery == Delivery::kArrived) {
      turns_made_ = answer.turns_made;
      return true;
    }
    if (delivery == Delivery::kLost) throw LinkError("simulation link: the runtime left before the first tick");
  } while (steady_clock::now() < deadline);
  return false;
}

void SimulatorEnd::give_up_runtime() {
  const std::uint64_t strangers = this->strangers();
  entities_.reset();  // before the next session of the domain begins
  entities_ = std::make_unique<Entities>(domain_, run_);
  strangers_before_ = strangers;
}

void SimulatorEnd::send(const Tick& tick) {
  const messages::Bearing bearing = tick.bearing.value_or(messages::Bearing{});
  const earshot_sim_Tick sample{.run = entities_->delivering.run(),
                                .number = tick.number,
                                .time_us = tick.time.us,
                                .navigation_messages = tick.navigation_messages,
                                .hydrophone_blocks = tick.hydrophone_blocks,
                                .snr_valid = tick.snr.has_value(),
                                .command = tick.command,
                                .snr_db = tick.snr.value_or(Decibels{}).value,
                                .snr_too_faint = tick.snr_too_faint,
                                .battery_valid = tick.battery_percent.has_value(),
                                .bearing_valid = tick.bearing.has_value(),
                                .bearing_ambiguous = bearing.mirror_axis.has_value(),
                                .battery_percent = tick.battery_percent.value_or(0.0),
                                .bearing_rad = bearing.direction.value,
                                .bearing_deviation_rad = bearing.deviation.value,
                                .bearing_axis_rad = bearing.mirror_axis.value_or(Radians{}).value};
  write(entities_->ticks, &sample, "a tick");
}

Delivery SimulatorEnd::receive(Answer& answer, std::chrono::milliseconds timeout) {
  return entities_->answers.take(answer, timeout);
}

std::uint64_t SimulatorEnd::strangers() const {
  return strangers_before_ + entities_->delivering.strangers();
}

void SimulatorEnd::observe(const GroundTruth& truth) {
  const earshot_sim_GroundTruth sample{.time_us = truth.time.us,
                                       .vehicle_north_m = truth.vehicle.north.value,
                                       .vehicle_east_m = truth.vehicle.east.value,
                                       .vehicle_depth_m = truth.vehicle_depth.value,
                                       .vehicle_heading_rad = truth.vehicle_heading.value,
                                       .source_north_m = truth.source.north.value,
                                       .source_east_m = truth.source.east.value,
                                       .range_m = truth.range.value};
  write(entities_->ground_truth, &sample, "ground truth");
}

}  // namespace earshot::link
