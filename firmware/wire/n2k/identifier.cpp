#include "firmware/wire/n2k/identifier.hpp"

namespace earshot::n2k {

namespace {

constexpr std::uint32_t kFirstBroadcastFormat = 240;  ///< PDU format from which the low byte belongs to the PGN

constexpr bool is_addressed(std::uint32_t pgn) {
  return ((pgn >> 8U) & 0xFFU) < kFirstBroadcastFormat;
}

}  // namespace

Result<std::uint32_t> compose(const Identifier& identifier) {
  if (identifier.priority > 7 || identifier.pgn > 0x3FFFFU) return Status::kOutOfRange;
  const bool addressed = is_addressed(identifier.pgn);
  if (addressed && (identifier.pgn & 0xFFU) != 0) return Status::kOutOfRange;
  if (!addressed && identifier.destination != kBroadcast) return Status::kOutOfRange;
  const std::uint32_t low_byte = addressed ? std::uint32_t{identifier.destination} << 8U : 0;
  return (std::uint32_t{identifier.priority} << 26U) | (identifier.pgn << 8U) | low_byte | identifier.source;
}

Result<Identifier> parse_identifier(std::uint32_t can_identifier) {
  if (can_identifier > 0x1FFFFFFFU) return Status::kOutOfRange;
  Identifier identifier;
  identifier.priority = static_cast<std::uint8_t>(can_identifier >> 26U);
  identifier.pgn = (can_identifier >> 8U) & 0x3FFFFU;
  identifier.source = static_cast<std::uint8_t>(can_identifier);
  if (is_addressed(identifier.pgn)) {
    identifier.destination = static_cast<std::uint8_t>(identifier.pgn);
    identifier.pgn &= 0x3FF00U;
  }
  return identifier;
}

}  // namespace earshot::n2k
