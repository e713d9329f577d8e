#include "firmware/wire/journal/closing_record.hpp"

#include "earshot/journal_end_t.hpp"
#include "firmware/messages/dictionary/mission_words.hpp"

namespace earshot::wire {

using messages::EndReason;
using messages::MissionState;

Encoded encoded(const ClosingRecord& record) {
  journal_end_t m{};
  m.utime = record.time.us;
  m.ending = static_cast<std::int8_t>(record.ending);
  m.state = static_cast<std::int8_t>(record.state);
  m.end_reason = static_cast<std::int8_t>(record.end_reason);
  m.steps_taken = static_cast<std::int32_t>(record.steps_taken);
  m.streams_lost = static_cast<std::int64_t>(record.lost.streams);
  m.steering_lost = static_cast<std::int64_t>(record.lost.steering);
  m.orders_lost = static_cast<std::int64_t>(record.lost.orders);
  return Encoded(m);
}

Status read_closing_record(std::span<const std::uint8_t> data, ClosingRecord& record) {
  journal_end_t m{};
  if (const Status status = decode(data, m); status != Status::kOk) return status;
  if (m.ending < 0 || m.ending > static_cast<std::int8_t>(Ending::kClockLost)) return Status::kOutOfRange;
  if (!messages::is_value_of<MissionState>(m.state)) return Status::kOutOfRange;
  if (!messages::is_value_of<EndReason>(m.end_reason)) return Status::kOutOfRange;
  if (m.steps_taken < 0 || m.streams_lost < 0 || m.steering_lost < 0 || m.orders_lost < 0) return Status::kOutOfRange;
  record = {.time = Time{m.utime},
            .ending = static_cast<Ending>(m.ending),
            .state = static_cast<MissionState>(m.state),
            .end_reason = static_cast<EndReason>(m.end_reason),
            .steps_taken = static_cast<std::uint32_t>(m.steps_taken),
            .lost = {.streams = static_cast<std::uint64_t>(m.streams_lost),
                     .steering = static_cast<std::uint64_t>(m.steering_lost),
                     .orders = static_cast<std::uint64_t>(m.orders_lost)}};
  return Status::kOk;
}

}  // namespace earshot::wire
