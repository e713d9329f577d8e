#include "firmware/boards/linux/can/trouble_watch.hpp"

#include <gtest/gtest.h>

#include <initializer_list>

namespace earshot::board {
namespace {

using enum BusTrouble;
using host::Role;

BusTroubles only(std::initializer_list<BusTrouble> troubles) {
  BusTroubles all;
  for (const BusTrouble trouble : troubles) all.set(static_cast<std::size_t>(trouble));
  return all;
}

/// A port with all roles on a bus where all is well, but for what a test changes.
class TroubleWatchTest : public testing::Test {
 protected:
  TroubleWatchTest() { signs_.has_address = true; }

  /// Time passes on both clocks, with a fix and an SNR a second if they come.
  BusTroubles after(int seconds) {
    BusTroubles troubles;
    for (int i = 0; i < seconds; ++i) {
      now_.host = now_.host + Duration::seconds(1);
      now_.mission = now_.mission + Duration::seconds(1);
      if (has_position_) signs_.readings.position = n2k::Reading<n2k::Geographic>{{}, now_.mission};
      if (has_heading_) signs_.readings.heading = n2k::Reading<Radians>{{}, now_.mission};
      if (has_pressure_) signs_.readings.pressure_pa = n2k::Reading<double>{0.0, now_.mission};
      if (has_pressure_ && is_gauge_) signs_.readings.depth = n2k::Reading<Meters>{{}, now_.mission};
      if (has_position_ && has_heading_ && has_pressure_ && is_gauge_ && is_near_) ++signs_.fixes;
      if (has_snr_) ++signs_.measurements;
      troubles = watch_.check(signs_, now_);
    }
    return troubles;
  }

  TroubleWatch watch_{host::kCanRoles, Duration::seconds(3)};
  BusSigns signs_;
  TroubleWatch::Now now_{.host = Time{7'000'000}, .mission = Time{1'795'000'000'000'000}};
  bool has_position_ = true;
  bool has_heading_ = true;
  bool has_pressure_ = true;
  bool is_gauge_ = true;
  bool is_near_ = true;
  bool has_snr_ = true;
};

TEST_F(TroubleWatchTest, SeesNothingWrongWithABusThatBringsAll) {
  EXPECT_EQ(after(100), only({}));
}

TEST_F(TroubleWatchTest, MissesWhatHasBeenSilentForFiveSecondsByItsName) {
  EXPECT_EQ(after(10), only({}));
  has_heading_ = false;
  EXPECT_EQ(after(4), only({}));
  EXPECT_EQ(after(1), only({kNoHeading}));
  has_heading_ = true;
  EXPECT_EQ(after(1), only({}));
}

TEST_F(TroubleWatchTest, TellsAPositionAHeadingAndAPressureApart) {
  has_position_ = false;
  EXPECT_EQ(after(6), only({kNoPosition}));
  has_position_ = true;
  has_pressure_ = false;
  EXPECT_EQ(after(6), only({kNoDepth}));
  has_heading_ = has_snr_ = false;
  EXPECT_EQ(after(6), only({kNoDepth, kNoHeading, kNoSnr}));
  has_position_ = false;
  EXPECT_EQ(after(6), only({kNoDepth, kNoHeading, kNoSnr, kNoPosition})) << "what was missing is missing still";
}

TEST_F(TroubleWatchTest, SaysWhyThereIsNoHeadingOrDepthThoughTheirDevicesSpeak) {
  has_heading_ = false;
  is_gauge_ = false;
  for (int i = 0; i < 10; ++i) {
    ++signs_.no_variation;
    (void)after(1);
  }
  EXPECT_EQ(after(1), only({kNoVariation, kSurfaceUnknown}));
}

TEST_F(TroubleWatchTest, SaysThatOthersThanTheNamedDevicesAreHeard) {
  has_position_ = has_heading_ = has_pressure_ = has_snr_ = false;
  for (int i = 0; i < 10; ++i) {
    ++signs_.not_chosen.position;
    ++signs_.not_chosen.heading;
    (void)after(1);
  }
  EXPECT_EQ(after(1), only({kOtherPosition, kOtherHeading, kNoDepth, kNoSnr}));
  for (int i = 0; i < 10; ++i) {
    ++signs_.not_chosen.pressure;
    ++signs_.not_chosen.snr;
    (void)after(1);
  }
  EXPECT_EQ(after(1), only({kNoPosition, kNoHeading, kOtherPressure, kOtherSnr})) << "the others are silent by now";
}

TEST_F(TroubleWatchTest, BlamesNothingOnTheBusThatHappenedWhileTheLinkWasDown) {
  (void)after(1);
  signs_.has_address = false;
  (void)after(1);
  signs_.unsent += 100;
  signs_.frames_lost += 100;
  now_.host = now_.host + Duration::seconds(60);
  now_.mission = now_.mission + Duration::seconds(60);
  watch_.restart(signs_, now_);
  has_position_ = has_snr_ = false;
  EXPECT_EQ(watch_.check(signs_, now_), only({}));
  signs_.has_address = true;
  EXPECT_EQ(after(4), only({})) << "and what is heard again gets its five seconds";
  EXPECT_EQ(after(1), only({kNoPosition, kNoSnr}));
}

TEST_F(TroubleWatchTest, SaysThatPositionsAreFarAwayWhereNothingElseIsMissing) {
  is_near_ = false;
  EXPECT_EQ(after(10), only({kFarAway}));
}

TEST_F(TroubleWatchTest, WaitsForFiveSecondsOfBothClocks) {
  (void)after(1);
  now_.host = now_.host + Duration::seconds(100);  // a simulator that pauses
  EXPECT_EQ(watch_.check(signs_, now_), only({}));
  (void)after(1);
  now_.mission = now_.mission + Duration::seconds(100);  // a rehearsal's mission clock
  EXPECT_EQ(watch_.check(signs_, now_), only({}));
}

TEST_F(TroubleWatchTest, GivesAClaimASecond) {
  signs_.has_address = false;
  EXPECT_EQ(after(1), only({}));
  EXPECT_EQ(after(1), only({kNoAddress}));
  signs_.has_address = true;
  EXPECT_EQ(after(1), only({}));
}

TEST_F(TroubleWatchTest, RemembersLostFramesForAMinuteAndUnsentMessagesForFiveSeconds) {
  (void)after(1);
  ++signs_.frames_lost;
  ++signs_.unsent;
  EXPECT_EQ(after(5), only({kFramesLost, kUnsent}));
  EXPECT_EQ(after(1), only({kFramesLost}));
  EXPECT_EQ(after(54), only({kFramesLost}));
  EXPECT_EQ(after(1), only({}));
}

TEST_F(TroubleWatchTest, SeesTheControllersStateAndADeviceOfTheSameName) {
  signs_.controller = n2k::ControllerState::kErrorPassive;
  EXPECT_EQ(after(1), only({kErrorPassive}));
  signs_.controller = n2k::ControllerState::kBusOff;
  EXPECT_EQ(after(1), only({kBusOff}));
  signs_.controller = n2k::ControllerState::kErrorActive;
  signs_.own_name_claims = 1;
  EXPECT_EQ(after(1), only({kSameName}));
}

TEST_F(TroubleWatchTest, MissesNothingThatItsPortHasNoRoleFor) {
  watch_ = TroubleWatch({Role::kAutopilot}, Duration::seconds(3));
  has_position_ = has_heading_ = has_pressure_ = has_snr_ = false;
  EXPECT_EQ(after(100), only({}));
}

}  // namespace
}  // namespace earshot::board
