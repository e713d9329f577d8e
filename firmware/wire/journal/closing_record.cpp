#include "firmware/wire/journal/closing_record.hpp"

#include <limits>

#include "firmware/messages/dictionary/journal_fields.hpp"
#include "firmware/wire/lcm/codec.hpp"

namespace earshot::wire {
namespace {

/// Others know only numbers with a sign.
bool is_count(std::uint64_t number) {
  return number <= static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max());
}

}  // namespace

Status read_closing_record(std::span<const std::uint8_t> data, messages::ClosingRecord& record) {
  messages::ClosingRecord read;
  if (const Status status = decode(data, read); status != Status::kOk) return status;
  const bool is_known = messages::is_known(read.ending) && messages::is_known(read.state) && messages::is_known(read.end_reason);
  const bool are_counts = read.steps_taken <= static_cast<std::uint32_t>(std::numeric_limits<std::int32_t>::max()) &&
                          is_count(read.lost.streams) && is_count(read.lost.steering) && is_count(read.lost.orders);
  if (!is_known || !are_counts) return Status::kOutOfRange;
  record = read;
  return Status::kOk;
}

}  // namespace earshot::wire
