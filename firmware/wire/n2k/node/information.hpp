#pragma once

#include <cstdint>
#include <span>

#include "firmware/core/fixed_vector.hpp"
#include "firmware/core/status.hpp"
#include "firmware/wire/n2k/node/identity.hpp"
#include "firmware/wire/n2k/table/messages.hpp"

namespace earshot::n2k {

/// The bytes of a message that says something about a device.
using Information = FixedVector<std::uint8_t, kMaxMessageSize>;

inline constexpr std::size_t kMostListedPgns = (kMaxMessageSize - 1) / 3;

enum class PgnListKind : std::uint8_t { kTransmitted = 0, kReceived = 1 };

/// Product information (126996). kOutOfRange: a text is too long, or not printable ASCII.
[[nodiscard]] Result<Information> product_information(const Product& product);

/// Configuration information (126998). Fails likewise.
[[nodiscard]] Result<Information> configuration_information(const Configuration& configuration);

/// A list of parameter groups (126464). kOutOfRange: over kMostListedPgns, or a number that none has.
[[nodiscard]] Result<Information> pgn_list(PgnListKind kind, std::span<const std::uint32_t> pgns);

/// Every group of the table that Earshot sends, or reads.
[[nodiscard]] std::span<const std::uint32_t> table_pgns(PgnListKind kind);

}  // namespace earshot::n2k
