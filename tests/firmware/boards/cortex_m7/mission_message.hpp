#pragma once

#include <cstdint>
#include <span>

#include "firmware/core/crc32.hpp"
#include "firmware/messages/journal_records.hpp"

namespace earshot::board {

/// A mission as a board is told it, with the checksums of what it flies by.
inline messages::MissionRecord message_of(const config::Mission& mission, std::span<const std::uint8_t> policy,
                                          std::span<const std::uint8_t> tables) {
  return {.mission = mission, .policy_crc32 = crc32(policy), .tables_crc32 = crc32(tables)};
}

}  // namespace earshot::board
