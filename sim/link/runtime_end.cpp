#include "sim/link/runtime_end.hpp"

#include <thread>

#include "sim.h"
#include "sim/link/dds_entities.hpp"

namespace earshot::link {
namespace {

Tick from_wire(const earshot_sim_Tick& sample) {
  return {.number = sample.number,
          .time = {sample.time_us},
          .navigation_messages = sample.navigation_messages,
          .snr = sample.snr_valid ? std::optional(Decibels{sample.snr_db}) : std::nullopt,
          .snr_too_faint = sample.snr_too_faint,
          .command = sample.command};
}

earshot_sim_Answer to_wire(const Answer& answer) {
  return {.number = answer.number,
          .setpoint_messages = answer.setpoint_messages,
          .steps_taken = answer.steps_taken,
          .state = answer.state,
          .end_reason = answer.end_reason};
}

}  // namespace

struct RuntimeEnd::Entities {
  explicit Entities(std::uint32_t domain) : session(domain) {}

  Mailbox<Tick> ticks;  // outlives the session, whose threads fill it
  Mailbox<Answer> outbox;
  Session session;
  dds_entity_t answers = make_writer(session, earshot_sim_Answer_desc);
  Delivering<earshot_sim_Tick, Tick, from_wire> delivering{session, earshot_sim_Tick_desc, ticks};
  std::thread answering{[this] { write_answers(); }};

  void write_answers() {
    // A volatile writer forgets what it writes before its reader is known, and the first tick may come before the simulator's reader is.
    constexpr std::chrono::milliseconds kPatience{2000};
    bool known = false;
    Answer answer;
    for (;;) {
      const Delivery delivery = outbox.take(answer, kPatience);
      if (delivery == Delivery::kLost) return;
      if (delivery == Delivery::kNothing) continue;
      known = known || wait_for_reader(answers, kPatience);
      const earshot_sim_Answer sample = to_wire(answer);
      dds_write(answers, &sample);  // a failure shows as the simulator not advancing
    }
  }
};

RuntimeEnd::RuntimeEnd(std::uint32_t domain) : entities_(std::make_unique<Entities>(domain)) {}

RuntimeEnd::~RuntimeEnd() {
  entities_->outbox.close();
  entities_->answering.join();
}

Delivery RuntimeEnd::receive(Tick& tick, std::chrono::milliseconds timeout) {
  return entities_->ticks.take(tick, timeout);
}

void RuntimeEnd::send(const Answer& answer) {
  entities_->outbox.put(answer);
}

}  // namespace earshot::link
