#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace earshot::policy {

/// Hypotheses side by side, as many as a vector unit takes at once: one value of each.
inline constexpr std::size_t kLanes = 8;
/// Their log weights, added and compared all at once; a number of them is an int16_t.
using LogLanes = std::int16_t __attribute__((vector_size(2 * kLanes)));
using FloatLanes = std::array<float, kLanes>;
/// Some of them.
using Lanes = std::array<bool, kLanes>;

}  // namespace earshot::policy
