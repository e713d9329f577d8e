#pragma once

#include <cstdint>
#include <span>

#include "firmware/core/status.hpp"
#include "firmware/messages/journal_records.hpp"

namespace earshot::wire {

/// kMalformed: the bytes are no closing record. kOutOfRange: they name an ending, a state or a reason that there is not, or a count below
/// zero.
[[nodiscard]] Status read_closing_record(std::span<const std::uint8_t> data, messages::ClosingRecord& record);

}  // namespace earshot::wire
