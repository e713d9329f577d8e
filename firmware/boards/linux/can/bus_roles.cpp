#include "firmware/boards/linux/can/bus_roles.hpp"

#include <initializer_list>

#include "firmware/wire/n2k/node/commanded_address.hpp"
#include "firmware/wire/n2k/table/messages.hpp"

namespace earshot::board {
namespace {

using host::Role;

void add(Pgns& pgns, std::initializer_list<std::uint32_t> more) {
  for (const std::uint32_t pgn : more) static_cast<void>(pgns.push_back(pgn));
}

}  // namespace

Pgns pgns_sent(host::Roles roles) {
  using namespace n2k;
  Pgns pgns;
  add(pgns,
      {kAcknowledgementPgn, kRequestPgn, kAddressClaimPgn, kPgnListPgn, kGroupFunctionPgn, kHeartbeatPgn, kProductPgn, kConfigurationPgn});
  if (roles.has(Role::kAutopilot)) add(pgns, {kSpeedDepthPgn, kHeadingControlPgn});
  if (roles.has(Role::kOperator)) add(pgns, {kPeerPgn, kChallengePgn});
  if (roles.has(Role::kStatus)) add(pgns, {kHealthPgn, kPortHealthPgn, kDecisionPgn});
  return pgns;
}

Pgns pgns_read(host::Roles roles) {
  using namespace n2k;
  Pgns pgns;
  add(pgns, {kRequestPgn, kAddressClaimPgn, kCommandedAddressPgn, kTransportControlPgn, kTransportDataPgn, kGroupFunctionPgn});
  if (roles.has(Role::kNavigation))
    add(pgns, {kHeadingPgn, kVariationPgn, kSpeedPgn, kPressurePgn, kPositionPgn, kGnssPgn, kWaterDepthPgn, kChargePgn, kLeakPgn});
  if (roles.has(Role::kSnr)) add(pgns, {kSnrPgn});
  if (roles.has(Role::kAutopilot)) add(pgns, {kAutopilotStatusPgn});
  if (roles.has(Role::kOperator)) add(pgns, {kPeerPgn});
  return pgns;
}

host::CanFilters filters_of(host::Roles roles) {
  host::CanFilters filters;
  static_cast<void>(host::filters_for(pgns_read(roles).span(), filters));  // every number is one of the table's, and there is room
  return filters;
}

}  // namespace earshot::board
