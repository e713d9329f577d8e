#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "firmware/core/time.hpp"
#include "firmware/host/journal/reading/entry.hpp"

namespace earshot::journal {

/// What a record says, by its channel. Values are as they came. Whoever reads a journal reads its records with this.
[[nodiscard]] Content decode_record(std::string_view channel, Time time, std::span<const std::uint8_t> data);

/// The channel in a journal of a message that was on a bus: there an input bears the number of its port, which a bus does not know.
[[nodiscard]] std::string journalled_channel(std::string_view channel);

}  // namespace earshot::journal
