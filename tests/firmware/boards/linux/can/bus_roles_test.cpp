#include "firmware/boards/linux/can/bus_roles.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "firmware/wire/n2k/table/messages.hpp"

namespace earshot::board {
namespace {

bool has(const Pgns& pgns, std::uint32_t pgn) {
  return std::ranges::find(pgns, pgn) != pgns.end();
}

TEST(BusRoles, OfAllTogetherHaveRoomForTheirGroupsInListsAndFilters) {
  EXPECT_LT(pgns_sent(host::kCanRoles).size(), kMostPgns);
  EXPECT_LT(pgns_read(host::kCanRoles).size(), kMostPgns);
  EXPECT_TRUE(has(pgns_sent(host::kCanRoles), n2k::kDecisionPgn)) << "the last that is added";
  EXPECT_TRUE(has(pgns_read(host::kCanRoles), n2k::kPeerPgn)) << "the last that is added";
}

TEST(BusRoles, SendAndReadNoGroupOfAnotherRole) {
  const Pgns sent = pgns_sent({host::Role::kNavigation});
  const Pgns read = pgns_read({host::Role::kAutopilot});
  for (const std::uint32_t pgn : {n2k::kSpeedDepthPgn, n2k::kHeadingControlPgn, n2k::kPeerPgn, n2k::kHealthPgn, n2k::kDecisionPgn})
    EXPECT_FALSE(has(sent, pgn)) << pgn;
  for (const std::uint32_t pgn : {n2k::kHeadingPgn, n2k::kPositionPgn, n2k::kLeakPgn, n2k::kSnrPgn, n2k::kPeerPgn})
    EXPECT_FALSE(has(read, pgn)) << pgn;
}

TEST(BusRoles, LetEveryGroupThatIsReadThroughTheKernelsFilterAndNoOther) {
  const host::CanFilters filters = filters_of({host::Role::kNavigation});
  const auto passes = [&](std::uint32_t identifier) {
    constexpr std::uint32_t kExtended = 0x8000'0000;
    return std::ranges::any_of(filters, [&](const host::CanFilter& filter) {
      return ((identifier | kExtended) & filter.mask) == (filter.identifier & filter.mask);
    });
  };
  EXPECT_TRUE(passes(0x09F1'1223)) << "127250 heading";
  EXPECT_TRUE(passes(0x15FD'0A26)) << "130314 pressure";
  EXPECT_TRUE(passes(0x0DF5'0B2A)) << "128267 altitude";
  EXPECT_TRUE(passes(0x19F2'122B)) << "127506 charge";
  EXPECT_TRUE(passes(0x04FF'0D2C)) << "65293 leak";
  EXPECT_TRUE(passes(0x18EE'FF55)) << "60928 claim";
  EXPECT_TRUE(passes(0x18EA'4055)) << "59904 request, to us";
  EXPECT_FALSE(passes(0x14FF'0B28)) << "65291 SNR";
  EXPECT_FALSE(passes(0x0CFF'0E23)) << "65294 autopilot";
  EXPECT_FALSE(passes(0x0DEF'4029)) << "126720 orders";
}

}  // namespace
}  // namespace earshot::board
