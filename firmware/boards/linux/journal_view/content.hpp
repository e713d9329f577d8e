#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "firmware/boards/linux/journal_view/entry.hpp"
#include "firmware/core/time.hpp"

namespace earshot::journal_view {

/// What a record says, by its channel. Values are as they came.
[[nodiscard]] Content content_of(std::string_view channel, Time time, std::span<const std::uint8_t> data);

}  // namespace earshot::journal_view
