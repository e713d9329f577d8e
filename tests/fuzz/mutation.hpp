#pragma once

#include <cstdint>
#include <vector>

#include "firmware/core/random.hpp"

namespace earshot::fuzz {

using Bytes = std::vector<std::uint8_t>;

/// The bytes of a good `.policy` file after one to four changes drawn from `random`: bits, bytes, numbers no one expects, sections dropped,
/// doubled, swapped, cut, renamed or of another length. Its length field and CRC-32 belong to what it holds; its signature does not.
[[nodiscard]] Bytes mutated(const Bytes& good, Pcg32& random);

}  // namespace earshot::fuzz
