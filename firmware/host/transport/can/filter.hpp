#pragma once

#include <cstdint>
#include <span>

#include "firmware/config/capacities.hpp"
#include "firmware/core/fixed_vector.hpp"
#include "firmware/core/status.hpp"

namespace earshot::host {

/// What the kernel lets through to a socket: frames whose identifier and this one agree in the bits of `mask`. As the kernel has them:
/// 29 bits, and above them the flags of its format (31: extended, 30: remote).
struct CanFilter {
  std::uint32_t identifier = 0;
  std::uint32_t mask = 0;
  friend constexpr bool operator==(const CanFilter&, const CanFilter&) = default;
};

/// A frame passes if one of them lets it through; if there is none, every frame passes.
using CanFilters = FixedVector<CanFilter, config::kCanFilters>;

/// Extended data frames of these groups, from whomever, at any priority, and to whomever where the group has a destination.
/// @param pgns  in any order, a group more than once too
/// @return kOutOfRange: a number that is no group's. kFull: more than kCanFilters. `filters` is then empty.
[[nodiscard]] Status filters_for(std::span<const std::uint32_t> pgns, CanFilters& filters);

/// Likewise, and adds the groups of `addressed` (PDU1: PF < 240) where they are sent to `address` or to everyone.
/// @param address  ours; another one needs new filters
[[nodiscard]] Status filters_for(std::span<const std::uint32_t> pgns, std::span<const std::uint32_t> addressed, std::uint8_t address,
                                 CanFilters& filters);

}  // namespace earshot::host
