#pragma once

#include <cstdint>
#include <span>

#include "earshot/mission_t.hpp"
#include "firmware/core/crc32.hpp"
#include "firmware/wire/lcm/conversion.hpp"

namespace earshot::board {

/// A mission as a board is told it, with the checksums of what it flies by.
inline mission_t message_of(const config::Mission& mission, std::span<const std::uint8_t> policy, std::span<const std::uint8_t> tables) {
  mission_t message = wire::to_message(mission, Time{});
  message.policy_crc32 = static_cast<std::int32_t>(crc32(policy));
  message.tables_crc32 = static_cast<std::int32_t>(crc32(tables));
  return message;
}

}  // namespace earshot::board
