#include "firmware/authority/command.hpp"

#include <gtest/gtest.h>

namespace earshot::authority {
namespace {

using messages::Authority;
using messages::CommandOutcome;
using messages::MissionState;
using messages::Order;

constexpr Time kNow{1'000'000'000};

messages::OperatorCommand order(Order what) {
  return {.time = kNow, .expiry = kNow + Duration::seconds(60), .issuer = 1, .number = 1, .order = what};
}

/// A command whose search was begun by `how`.
Command begun_by(Order how) {
  Command command;
  EXPECT_EQ(command.obey(order(how), MissionState::kStandby, true), CommandOutcome::kObeyed);
  command.begin();
  return command;
}

TEST(Command, RemembersASearchThatWasOrderedUntilItsOrderExpires) {
  Command command;
  EXPECT_FALSE(command.is_search_ordered(kNow));
  EXPECT_EQ(command.obey(order(Order::kStart), MissionState::kStandby, true), CommandOutcome::kObeyed);
  EXPECT_TRUE(command.is_search_ordered(kNow + Duration::seconds(60)));
  EXPECT_FALSE(command.is_search_ordered(kNow + Duration::seconds(60) + Duration{1}));
  command.begin();
  EXPECT_FALSE(command.is_search_ordered(kNow));
}

TEST(Command, IsEngagedByStartAndNotByListen) {
  EXPECT_FALSE(Command{}.is_engaged());
  EXPECT_TRUE(begun_by(Order::kStart).is_engaged());
  EXPECT_FALSE(begun_by(Order::kListen).is_engaged());
}

TEST(Command, DoesAsTheLastOfTwoOrdersSaysWhileItWaits) {
  Command command;
  (void)command.obey(order(Order::kListen), MissionState::kStandby, true);
  (void)command.obey(order(Order::kStart), MissionState::kStandby, true);
  command.begin();
  EXPECT_TRUE(command.is_engaged());
}

TEST(Command, TakesTheVehicleWhileListeningIfTheAutopilotIsHeard) {
  Command command = begun_by(Order::kListen);
  EXPECT_EQ(command.obey(order(Order::kStart), MissionState::kSearch, false), CommandOutcome::kAutopilotSilent);
  EXPECT_FALSE(command.is_engaged());
  EXPECT_EQ(command.obey(order(Order::kStart), MissionState::kSearch, true), CommandOutcome::kObeyed);
  EXPECT_TRUE(command.is_engaged());
}

TEST(Command, RefusesToSearchAgainOrToListenWhileItCommands) {
  Command commanding = begun_by(Order::kStart);
  EXPECT_EQ(commanding.obey(order(Order::kStart), MissionState::kSearch, true), CommandOutcome::kNotInThisState);
  EXPECT_EQ(commanding.obey(order(Order::kListen), MissionState::kSearch, true), CommandOutcome::kNotInThisState);
  EXPECT_TRUE(commanding.is_engaged());
  Command listening = begun_by(Order::kListen);
  EXPECT_EQ(listening.obey(order(Order::kListen), MissionState::kSearch, true), CommandOutcome::kNotInThisState);
  EXPECT_EQ(listening.obey(order(Order::kStart), MissionState::kDone, true), CommandOutcome::kNotInThisState);
  EXPECT_FALSE(listening.is_search_ordered(kNow));
}

TEST(Command, PausesOnceAndResumesOnce) {
  Command command = begun_by(Order::kStart);
  EXPECT_EQ(command.obey(order(Order::kResume), MissionState::kSearch, true), CommandOutcome::kNotInThisState);
  EXPECT_EQ(command.obey(order(Order::kPause), MissionState::kSearch, true), CommandOutcome::kObeyed);
  EXPECT_TRUE(command.is_paused());
  EXPECT_EQ(command.obey(order(Order::kPause), MissionState::kSearch, true), CommandOutcome::kRepeated);
  EXPECT_TRUE(command.is_paused());
  EXPECT_EQ(command.obey(order(Order::kResume), MissionState::kSearch, true), CommandOutcome::kObeyed);
  EXPECT_FALSE(command.is_paused());
}

TEST(Command, PausesNothingThatItDoesNotCommand) {
  Command listening = begun_by(Order::kListen);
  EXPECT_EQ(listening.obey(order(Order::kPause), MissionState::kSearch, true), CommandOutcome::kNotInThisState);
  Command done = begun_by(Order::kStart);
  EXPECT_EQ(done.obey(order(Order::kPause), MissionState::kDone, true), CommandOutcome::kNotInThisState);
  EXPECT_FALSE(done.is_paused());
}

TEST(Connected, IsWhoWaitsForNoStatusOrHasOneThatIsYoungEnough) {
  EXPECT_TRUE(is_connected({}, {}, kNow));
  const config::Authority waits{.needs_verified_commands = false, .autopilot_timeout = Duration::seconds(5)};
  EXPECT_FALSE(is_connected(waits, {}, kNow));
  const messages::AutopilotStatus status{.time = kNow, .follows_setpoints = false};
  EXPECT_TRUE(is_connected(waits, status, kNow + Duration::seconds(5)));
  EXPECT_FALSE(is_connected(waits, status, kNow + Duration::seconds(5) + Duration{1}));
}

TEST(AuthorityState, SaysWhetherAndForWhomTheVehicleIsCommanded) {
  EXPECT_EQ(state_of({}, MissionState::kStandby, false), Authority::kDisconnected);
  EXPECT_EQ(state_of({}, MissionState::kStandby, true), Authority::kStandby);
  EXPECT_EQ(state_of(begun_by(Order::kListen), MissionState::kSearch, false), Authority::kListen);
  EXPECT_EQ(state_of(begun_by(Order::kListen), MissionState::kDone, true), Authority::kStandby);
  EXPECT_EQ(state_of(begun_by(Order::kStart), MissionState::kSearch, false), Authority::kCommand);
  EXPECT_EQ(state_of(begun_by(Order::kStart), MissionState::kDone, true), Authority::kCommand);
  EXPECT_EQ(state_of(begun_by(Order::kStart), MissionState::kAbort, true), Authority::kAbort);
  EXPECT_EQ(state_of({}, MissionState::kAbort, false), Authority::kAbort);
}

}  // namespace
}  // namespace earshot::authority
