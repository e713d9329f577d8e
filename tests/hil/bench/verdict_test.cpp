#include "hil/bench/verdict.hpp"

#include <gtest/gtest.h>

#include <csignal>
#include <limits>
#include <string>

#include "firmware/host/program/exit_status.hpp"
#include "firmware/messages/dictionary/mission_words.hpp"
#include "tests/hil/bench/judged_mission.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot::hil {
namespace {

/// A halt polygon 1 km around that square.
config::Fence fence() {
  config::Fence fence;
  for (const NorthEast& corner : {NorthEast{Meters{-1000}, Meters{-1000}}, NorthEast{Meters{11'000}, Meters{-1000}},
                                  NorthEast{Meters{11'000}, Meters{11'000}}, NorthEast{Meters{-1000}, Meters{11'000}}})
    (void)fence.halt.push_back(corner);
  return fence;
}

TruePlace place(std::int64_t s, double north_m, double east_m, double depth_m = 300.0) {
  return {.time = at_s(s), .position = {Meters{north_m}, Meters{east_m}}, .depth = Meters{depth_m}};
}

using messages::ControllerState;

messages::ControllerTrouble trouble(ControllerState state, bool is_there) {
  return {.time = at_s(30), .port = 1, .trouble = state, .is_there = is_there};
}

/// A flight that found the source and its journal, without a fault: nothing is wrong with them.
class VerdictTest : public testing::Test {
 protected:
  VerdictTest() {
    case_.expected.end = messages::EndReason::kCompleted;
    flight_.end = messages::EndReason::kCompleted;
    flight_.exit_statuses = {program::kDone};
    flight_.last = at_s(1000);
    flight_.track = {place(0, 5'000, 5'000), place(1, 5'000, 5'002)};
    journal_.end = messages::EndReason::kCompleted;
    journal_.setpoints = 2;
    journal_.is_same_again = true;
  }
  [[nodiscard]] Words broken() const { return broken_promises(case_, mission_, flight_, journal_); }
  [[nodiscard]] Words unmet() const { return unmet_expectations(case_, flight_, journal_); }

  config::Mission mission_ = mission();
  Case case_;
  BenchFlight flight_;
  JournalFindings journal_;
};

TEST_F(VerdictTest, FindsNothingWrongWithAFlightThatWentAsItHadTo) {
  EXPECT_EQ(broken(), Words{});
  EXPECT_EQ(unmet(), Words{});
}

TEST_F(VerdictTest, SaysWhyAFlightWasNotFlownToItsEnd) {
  flight_.failure = "the bus takes no frames";
  EXPECT_EQ(broken(), Words{"the bus takes no frames"});
}

TEST_F(VerdictTest, TakesNoExitStatusOfAnEarshotdThatCrashedOrLostSomething) {
  for (const int status : {program::kIncomplete, program::kBadInput, program::kLost, 128 + SIGSEGV, 128 + SIGKILL}) {
    flight_.exit_statuses = {status, program::kDone};
    EXPECT_EQ(broken(), Words{"earshotd ended with status " + std::to_string(status)});
  }
  for (const int status : {program::kDone, program::kAborted, program::kInterrupted}) {
    flight_.exit_statuses = {status};
    EXPECT_EQ(broken(), Words{}) << status;
  }
}

TEST_F(VerdictTest, SaysWhatTheLastEarshotdSaidLast) {
  flight_.exit_statuses = {program::kLost, program::kBadInput};
  flight_.last_words = "mission.toml: no such file";
  EXPECT_TRUE(support::lines_tell(broken(), {{"earshotd", "ended", "status 3"}, {"ended", "status 2", "mission.toml", "no"}}));
}

TEST_F(VerdictTest, LetsAnEarshotdDieOfTheSignalThatTheCaseSentAndLoseItsJournalOnAFullDisk) {
  flight_.exit_statuses = {128 + SIGKILL, program::kDone};
  case_.faults = {{.fault = Fault::kKill, .from = at_s(60)}};
  EXPECT_EQ(broken(), Words{});
  flight_.exit_statuses = {program::kLost};
  EXPECT_EQ(broken(), Words{"earshotd ended with status 3"});
  case_.faults = {{.fault = Fault::kFullDisk, .from = at_s(0), .amount = 50'000}};
  EXPECT_EQ(broken(), Words{});
}

TEST_F(VerdictTest, WantsAJournalThatCanBeReadAndGivesEveryOutputAgain) {
  journal_.is_same_again = false;
  journal_.difference = "record 7 (EARSHOT_HEALTH)";
  EXPECT_TRUE(support::lines_tell(broken(), {{"not", "again", "7", "EARSHOT_HEALTH"}}));
  journal_.trouble = "no such file";
  EXPECT_TRUE(support::lines_tell(broken(), {{"journal", "cannot", "read", "no", "file"}}));
}

TEST_F(VerdictTest, LetsAJournalOnAFullDiskHaveAnEnd) {
  journal_.is_same_again = false;
  case_.faults = {{.fault = Fault::kFullDisk, .from = at_s(0), .amount = 50'000}};
  EXPECT_EQ(broken(), Words{});
}

TEST_F(VerdictTest, LetsAJournalInWhichABitFlippedBeAnother) {
  journal_.is_same_again = false;
  case_.faults = {{.fault = Fault::kFlippedBit, .from = at_s(60)}};
  EXPECT_EQ(broken(), Words{});
}

TEST_F(VerdictTest, NamesEverySetPointBeyondTheLimits) {
  journal_.beyond_limits = {"one", "another"};
  EXPECT_EQ(broken(), (Words{"one", "another"}));
}

TEST_F(VerdictTest, WantsTheVehicleWithinItsAreaWhereThereIsNoFence) {
  flight_.track.push_back(place(2, 10'000, 10'000));
  EXPECT_EQ(broken(), Words{});
  flight_.track.push_back(place(3, 10'000.1, 10'000));
  EXPECT_TRUE(support::lines_tell(broken(), {{"vehicle", "beyond", "polygon", "3 s"}}));
}

TEST_F(VerdictTest, WantsTheVehicleWithinTheHaltPolygonOfItsFence) {
  mission_.safety.fence = fence();
  flight_.track.push_back(place(2, 10'999, -999));
  EXPECT_EQ(broken(), Words{});
  flight_.track.push_back(place(3, 11'001, -999));
  flight_.track.push_back(place(4, 11'002, -999));
  EXPECT_TRUE(support::lines_tell(broken(), {{"vehicle", "beyond", "polygon", "3 s"}})) << "once";
}

TEST_F(VerdictTest, WantsTheVehicleNoDeeperThan25MetresBelowItsLimit) {
  flight_.track.push_back(place(2, 5'000, 5'000, 345.0));
  EXPECT_EQ(broken(), Words{});
  flight_.track.push_back(place(3, 5'000, 5'000, 345.1));
  EXPECT_EQ(broken(), Words{"the vehicle was too deep at 3 s"});
}

TEST_F(VerdictTest, TakesNoPlaceThatIsNoNumber) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  flight_.track.push_back(place(2, 5'000, 5'000, kNan));
  EXPECT_EQ(broken(), Words{"the vehicle was too deep at 2 s"});
  flight_.track.back() = place(2, kNan, 5'000);
  EXPECT_TRUE(support::lines_tell(broken(), {{"vehicle", "beyond", "polygon", "2 s"}}));
  mission_.safety.fence = fence();
  EXPECT_TRUE(support::lines_tell(broken(), {{"vehicle", "beyond", "polygon", "2 s"}}));
}

TEST_F(VerdictTest, LetsAVehicleThatCannotDoAsItIsToldGoAstrayButNoOther) {
  flight_.track.push_back(place(2, 12'000, 5'000));
  for (const Fault fault :
       {Fault::kRudderStuck, Fault::kPlanesStuck, Fault::kNoThrust, Fault::kDisengaged, Fault::kObstinate, Fault::kCurrent, Fault::kFrozen,
        Fault::kPositionError, Fault::kDepthError, Fault::kSecondNavigation, Fault::kReplay}) {
    case_.faults = {{.fault = Fault::kLeak, .from = {}}, {.fault = fault, .from = {}, .amount = 1.0}};
    EXPECT_EQ(broken(), Words{}) << static_cast<int>(fault);
    EXPECT_TRUE(is_beyond_command(case_.faults[1], mission_));
  }
  for (const Fault fault : {Fault::kLoss, Fault::kDelay, Fault::kCorruption, Fault::kKill, Fault::kStrangersOrder, Fault::kInterfaceDown,
                            Fault::kSecondAutopilot, Fault::kHeadingError}) {
    case_.faults = {{.fault = fault, .from = {}}};
    EXPECT_TRUE(support::lines_tell(broken(), {{"vehicle", "beyond", "polygon", "2 s"}})) << static_cast<int>(fault);
  }
}

TEST_F(VerdictTest, WantsTheVehicleWithinInACurrentThatItsMissionKnows) {
  flight_.track.push_back(place(2, 12'000, 5'000));
  mission_.safety.vehicle.max_current = MetersPerSecond{0.5};
  case_.faults = {{.fault = Fault::kCurrent, .from = {}, .amount = 0.5}};
  EXPECT_TRUE(support::lines_tell(broken(), {{"vehicle", "beyond", "polygon", "2 s"}}));
  case_.faults[0].amount = 0.6;
  EXPECT_EQ(broken(), Words{});
}

TEST_F(VerdictTest, WantsTheEndOfTheCase) {
  case_.expected.end = messages::EndReason::kNavigationStale;
  EXPECT_TRUE(support::lines_tell(unmet(), {{"mission", "ended otherwise", messages::to_string(messages::EndReason::kCompleted), "not",
                                             messages::to_string(messages::EndReason::kNavigationStale)}}));
}

TEST_F(VerdictTest, WantsOneEndInTheJournalAndInTheLastAnswer) {
  journal_.end = messages::EndReason::kSafetyRule;
  EXPECT_TRUE(support::lines_tell(unmet(), {{"journal", "earshotd's", "answer"}}));
  case_.faults = {{.fault = Fault::kFullDisk, .from = at_s(0), .amount = 50'000}};
  EXPECT_EQ(unmet(), Words{}) << "a full disk took no more of it";
}

TEST_F(VerdictTest, WantsNoEndInTheJournalOfAVehicleThatIsBroughtUpWithoutOne) {
  case_.expected.end = flight_.end = messages::EndReason::kOutage;
  journal_.end = messages::EndReason::kNone;
  EXPECT_EQ(unmet(), Words{});
}

TEST_F(VerdictTest, TakesASearchUnderWayThatWasToldToStopWhenItsTimeWasUp) {
  case_.expected.end = messages::EndReason::kNone;
  flight_.end = messages::EndReason::kNone;
  journal_.end = messages::EndReason::kOperatorAbort;
  EXPECT_EQ(unmet(), Words{});
  journal_.end = messages::EndReason::kSafetyRule;
  EXPECT_TRUE(support::lines_tell(unmet(), {{"journal", "earshotd's", "answer"}}));
}

TEST_F(VerdictTest, WantsEveryRuleOfTheCaseToFireAfterItsFirstFault) {
  case_.faults = {{.fault = Fault::kLeak, .from = at_s(100)}, {.fault = Fault::kDeaf, .from = at_s(60)}};
  case_.expected.rules = {config::Condition::kLeak, config::Condition::kHydrophoneDeaf};
  EXPECT_EQ(unmet(), (Words{"the rule leak did not fire", "the rule hydrophone_deaf did not fire"}));
  journal_.events = {event(59, config::Condition::kLeak), event(60, config::Condition::kHydrophoneDeaf)};
  EXPECT_EQ(unmet(), Words{"the rule leak did not fire"}) << "that was before any fault";
  journal_.events = {event(70, config::Condition::kLeak, false), event(60, config::Condition::kHydrophoneDeaf)};
  EXPECT_EQ(unmet(), Words{"the rule leak did not fire"}) << "that was its end";
  journal_.events = {event(70, config::Condition::kLeak), event(60, config::Condition::kHydrophoneDeaf)};
  EXPECT_EQ(unmet(), Words{});
}

TEST_F(VerdictTest, CountsAFaultAtTheVeryBeginningAsTheFirst) {
  case_.faults = {{.fault = Fault::kLeak, .from = at_s(0)}, {.fault = Fault::kDeaf, .from = at_s(60)}};
  case_.expected.rules = {config::Condition::kLeak};
  journal_.events = {event(2, config::Condition::kLeak)};
  EXPECT_EQ(unmet(), Words{});
}

TEST_F(VerdictTest, WantsNoOtherRuleToFireUnlessTheCaseLetsIt) {
  journal_.events = {event(30, config::Condition::kSpeed, false), event(31, config::Condition::kSpeed),
                     event(32, config::Condition::kDepth)};
  EXPECT_EQ(unmet(), Words{"the rule speed_mps fired at 31 s"}) << "the first";
  case_.expected.only_these = false;
  EXPECT_EQ(unmet(), Words{});
}

TEST_F(VerdictTest, WantsFixesAndOrdersRefusedWhereTheCaseSaysSo) {
  case_.expected.refuses_navigation = true;
  case_.expected.refuses_commands = true;
  EXPECT_EQ(unmet(), (Words{"no fix was refused", "no order was refused"}));
  journal_.counters.navigation_refused = 1;
  EXPECT_EQ(unmet(), Words{"no order was refused"});
  journal_.counters.commands_refused = 1;
  EXPECT_EQ(unmet(), Words{});
}

TEST_F(VerdictTest, WantsDecisionsTakenUnderTheFault) {
  case_.faults = {{.fault = Fault::kKill, .from = at_s(100)}};
  case_.expected.decisions = 1;
  journal_.decisions = {at_s(1), at_s(99)};
  EXPECT_TRUE(support::lines_tell(unmet(), {{"after", "fault", "0", "not 1"}})) << "these were taken without it";
  journal_.decisions.push_back(at_s(100));
  EXPECT_EQ(unmet(), Words{});
}

TEST_F(VerdictTest, WantsTheVehicleTrulyUpWhereTheCaseSaysSo) {
  case_.expected.comes_up = true;
  EXPECT_EQ(unmet(), Words{"the vehicle did not come up"});
  flight_.track.push_back(place(2, 5'000, 5'000, 0.9));
  EXPECT_EQ(unmet(), Words{});
  flight_.track.push_back(place(3, 5'000, 5'000, 1.1));
  EXPECT_EQ(unmet(), Words{"the vehicle did not come up"}) << "it sank again";
}

TEST_F(VerdictTest, WantsTheWeightReleasedWhereTheCaseSaysSo) {
  case_.expected.releases_weight = true;
  EXPECT_EQ(unmet(), Words{"the weight was not released"});
  flight_.is_weight_released = true;
  EXPECT_EQ(unmet(), Words{});
}

TEST_F(VerdictTest, TakesNoCaseWhoseFaultNeverActed) {
  case_.faults = {{.fault = Fault::kLeak, .from = at_s(5000)}, {.fault = Fault::kDeaf, .from = at_s(60)}};
  flight_.idle = {case_.faults.front()};
  EXPECT_EQ(unmet(), Words{"the fault never acted: leak from 5000 s"});
}

TEST_F(VerdictTest, TakesNoCaseWhoseFaultOfFramesMetNone) {
  case_.faults = {{.fault = Fault::kLoss, .from = at_s(60), .device = "speed-log", .pgn = 127250}};
  EXPECT_EQ(unmet(), Words{"no frame met the fault"});
  flight_.afflicted = 1;
  EXPECT_EQ(unmet(), Words{});
}

TEST_F(VerdictTest, WantsFramesRefusedByTheKernelWhereTheCaseSaysSo) {
  case_.expected.refuses_frames = true;
  EXPECT_EQ(unmet(), Words{"the kernel had room for every frame"});
  flight_.refused = 1;
  EXPECT_EQ(unmet(), Words{});
}

TEST_F(VerdictTest, WantsAnEarshotdThatRefusesToFlyToEndWithStatusTwoAndNothingElseOfIt) {
  case_.expected.refuses_to_fly = true;
  EXPECT_EQ(broken(), Words{"earshotd did not refuse to fly"});
  flight_.exit_statuses = {program::kBadInput};
  journal_.trouble = "no such file";
  EXPECT_EQ(broken(), Words{});
}

TEST_F(VerdictTest, LetsAnEarshotdLoseItsJournalOnADiskThatIsReadOnlyButNotOnOneThatIsSlow) {
  journal_.is_same_again = false;
  flight_.exit_statuses = {program::kLost};
  case_.faults = {{.fault = Fault::kReadOnlyDisk, .from = at_s(40)}};
  EXPECT_EQ(broken(), Words{});
  case_.faults = {{.fault = Fault::kSlowDisk, .from = at_s(40)}};
  EXPECT_EQ(broken(), (Words{"earshotd ended with status 3", "the journal is not given again: "}));
}

TEST_F(VerdictTest, LetsNoEarshotdDieOfASignalThatWasTheVehiclesProgramToBear) {
  flight_.exit_statuses = {128 + SIGKILL};
  case_.faults = {{.fault = Fault::kKill, .from = at_s(40), .device = "vehicle"}};
  EXPECT_EQ(broken(), Words{"earshotd ended with status 137"});
  case_.faults.front().device = "earshotd";
  EXPECT_EQ(broken(), Words{});
}

TEST_F(VerdictTest, WantsNoneRefusedWhereTheCaseSaysSo) {
  case_.expected.refuses_navigation = false;
  case_.expected.refuses_commands = false;
  EXPECT_EQ(unmet(), Words{});
  journal_.counters.navigation_refused = 3;
  journal_.counters.commands_refused = 1;
  EXPECT_TRUE(support::lines_tell(unmet(), {{"refused", "none", "be", "3 times"}, {"refused", "none", "be", "1 times"}}));
}

TEST_F(VerdictTest, WantsNothingLostOnItsWayInWhereTheCaseSaysSo) {
  journal_.lost = {0, 4, 3};
  EXPECT_EQ(unmet(), Words{});
  case_.expected.loses_nothing = true;
  EXPECT_EQ(unmet(), Words{"lost on their way in: 7 frames"});
}

TEST_F(VerdictTest, WantsTheJournalToSayWhenTheControllersTroubleBeganAndWhenItEnded) {
  case_.faults = {{.fault = Fault::kErrorPassive, .from = at_s(20), .until = at_s(80)}};
  EXPECT_TRUE(support::lines_tell(unmet_expectations(case_, flight_, journal_),
                                  {{"not", "began", "20 s", "60 s"}, {"not", "ended", "20 s", "60 s"}}));
  journal_.troubles = {trouble(ControllerState::kBusOff, true), trouble(ControllerState::kBusOff, false)};
  EXPECT_EQ(unmet_expectations(case_, flight_, journal_).size(), 2U) << "another trouble";
  journal_.troubles = {trouble(ControllerState::kErrorPassive, true), trouble(ControllerState::kErrorPassive, false)};
  EXPECT_EQ(unmet_expectations(case_, flight_, journal_), Words{});
  case_.faults = {{.fault = Fault::kBusOff, .from = at_s(20)}};
  journal_.troubles = {trouble(ControllerState::kBusOff, true)};
  EXPECT_EQ(unmet_expectations(case_, flight_, journal_), Words{}) << "it never ends";
}

TEST_F(VerdictTest, WantsTheJournalToSayThatSamplesWereLost) {
  case_.sound_port = 2;
  case_.faults = {{.fault = Fault::kSoundDropout, .from = at_s(20), .until = at_s(40)}};
  journal_.lost.at(1) = 7;
  EXPECT_TRUE(support::lines_tell(unmet_expectations(case_, flight_, journal_), {{"journal", "not report", "samples", "lost"}}))
      << "messages were";
  journal_.lost.at(2) = 9'000;
  EXPECT_EQ(unmet_expectations(case_, flight_, journal_), Words{});
}

TEST_F(VerdictTest, FailsWhereTheKernelHasNotCountedAFault) {
  flight_.uncounted = {"the kernel has counted no frame that netem dropped"};
  EXPECT_TRUE(support::lines_tell(unmet_expectations(case_, flight_, journal_), {{"kernel", "counted", "no", "dropped"}}));
}

}  // namespace
}  // namespace earshot::hil
