#include "firmware/host/transport/can/filter.hpp"

#include <linux/can.h>

#include <algorithm>

#include "firmware/wire/n2k/identifier.hpp"

namespace earshot::host {

namespace {

// The mask's bits: 8..25 hold the group, of which 8..15 are the destination where there is one; 0..7 the source, 26..28 the priority.
constexpr std::uint32_t kExtendedDataFrame = CAN_EFF_FLAG | CAN_RTR_FLAG;
constexpr std::uint32_t kGroup = 0x03FFFF00;
constexpr std::uint32_t kGroupWithoutDestination = 0x03FF0000;
constexpr std::uint32_t kFirstBroadcastGroup = 0xF000;  ///< in the group's low 16 bits; below, the low byte is a destination

constexpr bool is_addressed(std::uint32_t pgn) {
  return (pgn & 0xFFFFU) < kFirstBroadcastGroup;
}

Status add(const CanFilter& filter, CanFilters& filters) {
  return std::ranges::find(filters, filter) != filters.end() ? Status::kOk : filters.push_back(filter);
}

Status add_group(std::uint32_t pgn, CanFilters& filters) {
  const Result<std::uint32_t> identifier = n2k::compose({.pgn = pgn, .priority = 0, .source = 0, .destination = n2k::kBroadcast});
  if (!identifier.ok()) return identifier.status();
  const std::uint32_t mask = is_addressed(pgn) ? kGroupWithoutDestination : kGroup;
  return add({.identifier = CAN_EFF_FLAG | (identifier.value() & mask), .mask = kExtendedDataFrame | mask}, filters);
}

Status add_group_to(std::uint32_t pgn, std::uint8_t destination, CanFilters& filters) {
  if (!is_addressed(pgn)) return Status::kOutOfRange;
  const Result<std::uint32_t> identifier = n2k::compose({.pgn = pgn, .priority = 0, .source = 0, .destination = destination});
  if (!identifier.ok()) return identifier.status();
  return add({.identifier = CAN_EFF_FLAG | identifier.value(), .mask = kExtendedDataFrame | kGroup}, filters);
}

}  // namespace

Status filters_for(std::span<const std::uint32_t> pgns, CanFilters& filters) {
  return filters_for(pgns, {}, n2k::kNullAddress, filters);
}

Status filters_for(std::span<const std::uint32_t> pgns, std::span<const std::uint32_t> addressed, std::uint8_t address,
                   CanFilters& filters) {
  filters.clear();
  Status status = Status::kOk;
  for (const std::uint32_t pgn : pgns) {
    if (status == Status::kOk) status = add_group(pgn, filters);
  }
  for (const std::uint32_t pgn : addressed) {
    if (status == Status::kOk) status = add_group_to(pgn, address, filters);
    if (status == Status::kOk) status = add_group_to(pgn, n2k::kBroadcast, filters);
  }
  if (status != Status::kOk) filters.clear();
  return status;
}

}  // namespace earshot::host
