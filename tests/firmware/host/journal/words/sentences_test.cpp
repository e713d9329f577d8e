#include "firmware/host/journal/words/sentences.hpp"

#include <gtest/gtest.h>

#include "tests/firmware/host/journal/known_journal.hpp"

namespace earshot::journal {
namespace {

TEST(JournalSentence, SaysAMissionInKilometresAndWhoFlewIt) {
  EXPECT_EQ(to_string(known_mission()),
            "mission begins: area of 25.0 km x 20.0 km, at 300 m depth and 2.0 m/s, up to 100 steps of 1000 m in 60000 s; detection "
            "threshold 10.0 dB; software 0.1.0, commit abc");
}

TEST(JournalSentence, SpellsOutWhatABuildCouldSteerATerminalWith) {
  messages::MissionRecord mission = known_mission();
  mission.build[0] = 0x1B;
  EXPECT_NE(to_string(mission).find("software \\x1b.1.0, commit abc"), std::string::npos) << to_string(mission);
}

TEST(JournalSentence, LeavesTheNameOfAnotherProgramInOnePiece) {
  messages::MissionRecord mission = known_mission();
  mission.build = {'m', 'y', '_', 'c', 'o', 'r', 'e'};
  EXPECT_TRUE(to_string(mission).ends_with("; software my_core")) << to_string(mission);
}

TEST(JournalSentence, SaysATightenWithItsLimits) {
  messages::OperatorCommand command = command_to(messages::Order::kTighten);
  command.issuer = 7;
  command.number = 4'294'967'295;
  command.limits = {.max_depth = Meters{280}, .max_time_s = 600.0};
  EXPECT_EQ(to_string(command, 2), "order TIGHTEN, number 4294967295 of issuer 7 to 280.0 m depth, 600 s of search, by port 2");
}

TEST(JournalSentence, TellsAnOrderOfTheProgramItselfFromOneOfAnOperator) {
  EXPECT_EQ(to_string(command_to(messages::Order::kAbort), 0), "order ABORT, number 0 of issuer 0, by the program, which is being stopped");
}

TEST(JournalSentence, SaysWhyAnOrderWasRefused) {
  messages::CommandAcknowledgement m;
  m.order = messages::Order::kStart;
  m.issuer = 4'294'967'295;
  m.outcome = messages::CommandOutcome::kTooOld;
  EXPECT_EQ(to_string(m), "order START, number 0 of issuer 4294967295: refused: too old");
  m.order = messages::Order{99};
  m.outcome = messages::CommandOutcome{99};
  EXPECT_EQ(to_string(m), "order an unknown order, number 0 of issuer 4294967295: an unknown outcome");
}

messages::Decision step_towards(double north_m, double east_m) {
  messages::Decision m;
  m.snr = Decibels{-3.25};
  m.waypoint = at(north_m, east_m);
  return m;
}

// 600 and 800 are the sides of a right triangle of 1000; its angle from north is atan(800/600) = 53.13 degrees.
TEST(JournalSentence, SaysWhereADecisionGoes) {
  EXPECT_EQ(to_string(step_towards(600, 800)), "step 0: SNR -3.2 dB, no detection; from 0 m north, 0 m east goes 1000 m towards 053 deg");
  EXPECT_EQ(to_string(step_towards(-1000, 0)), "step 0: SNR -3.2 dB, no detection; from 0 m north, 0 m east goes 1000 m towards 180 deg");
  // 0.06 degrees west of north: 359.94, and no compass has 360.
  EXPECT_NE(to_string(step_towards(1000, -1)).find("towards 000 deg"), std::string::npos);
}

TEST(JournalSentence, SaysThatASignalWasTooFaintAndWhatIsBelieved) {
  messages::Decision m = step_towards(1000, 0);
  m.too_faint = true;
  m.overridden = true;
  m.belief = messages::BeliefSummary{.likeliest = at(12'345.6, 6'000.0), .mean = at(9'000.0, 0.0), .spread = Meters{890}};
  EXPECT_EQ(
      to_string(m),
      "step 0: SNR below -3.2 dB, no detection; from 0 m north, 0 m east goes 1000 m towards 000 deg, as the safety layer changed it; "
      "the source is likeliest at 12346 m north, 6000 m east, the belief spread over 890 m");
}

TEST(JournalSentence, SaysFromWhereTheSourceWasHeardAndWhatItsMirrorImageIs) {
  messages::Decision m = step_towards(1000, 0);
  m.bearing = messages::Bearing{.direction = Radians{0.8203}, .deviation = Radians{0.1745}};  // 47 and 10 degrees
  EXPECT_EQ(to_string(m),
            "step 0: SNR -3.2 dB, no detection, from 47 deg, give or take 10 deg; from 0 m north, 0 m east goes 1000 m towards 000 deg");
  m.bearing->mirror_axis = Radians{0.3491};  // 20 degrees: 2 x 20 - 47 = -7
  EXPECT_EQ(to_string(m),
            "step 0: SNR -3.2 dB, no detection, from 47 deg or 353 deg, give or take 10 deg; from 0 m north, 0 m east goes 1000 m towards "
            "000 deg");
}

TEST(JournalSentence, SaysWhoHoldsASearchBack) {
  messages::Health m;
  m.state = messages::MissionState::kSearch;
  m.authority = messages::Authority::kListen;
  EXPECT_EQ(to_string(m, false), "SEARCH, listening: it commands nothing");
  m.authority = messages::Authority::kCommand;
  m.is_paused = true;
  EXPECT_EQ(to_string(m, false), "SEARCH, paused by an operator");
  m.authority = messages::Authority::kDisconnected;
  EXPECT_EQ(to_string(m, false), "SEARCH, the autopilot is not heard");
  m.end_reason = messages::EndReason::kNavigationStale;
  m.state = messages::MissionState::kAbort;
  m.steps_taken = 12;
  EXPECT_EQ(to_string(m, false), "ABORT, navigation went silent, after 12 steps");
}

TEST(JournalSentence, SaysHowAJournalEndsAndWhatItLost) {
  messages::ClosingRecord closing{
      .time = kBegan, .ending = messages::Ending::kStopped, .state = messages::MissionState::kSearch, .steps_taken = 1};
  EXPECT_EQ(to_string(closing), "end: the program was stopped; SEARCH, after 1 step; no record was lost");
  closing.lost = {.streams = 5, .steering = 1, .orders = 0};
  EXPECT_EQ(to_string(closing),
            "end: the program was stopped; SEARCH, after 1 step; 6 records lost on a full or slow disk: 5 of navigation, SNR and "
            "health, 1 set-points and decisions, 0 orders and changes of state");
}

TEST(JournalSentence, SaysWhereAJournalIsDamagedAndHowMuch) {
  EXPECT_EQ(to_string(MissingRecords{.first = 7, .count = 2, .first_part = 3, .parts = 1}),
            "2 records are missing, numbers 7 to 8: part 3 of the journal is not there");
  EXPECT_EQ(to_string(MissingRecords{.first = 7, .count = 2, .first_part = 3, .parts = 2}),
            "2 records are missing, numbers 7 to 8: parts 3 to 4 of the journal are not there");
  EXPECT_EQ(to_string(MissingRecords{.first = 7, .count = 1, .was_damaged = true}),
            "1 record is missing, number 7, where the file is damaged");
  EXPECT_EQ(to_string(MissingRecords{.first = 7, .count = 3}), "3 records are missing, numbers 7 to 9: the disk was full or too slow");
  EXPECT_EQ(to_string(DamagedBytes{.offset = 100, .bytes = 45}),
            "damaged: 45 bytes from byte 100 on are no record, or do not match their checksum");
  EXPECT_EQ(to_string(NumbersGoBack{.from = 9, .to = 0}),
            "the records' numbers go back from 9 to 0: what follows was not written behind it");
  EXPECT_EQ(to_string(TornEnd{.where = {.offset = 90, .bytes = 1}, .is_cut = true}),
            "the journal ends in the middle of a record (1 byte from byte 90 on): its program was stopped while it wrote");
  EXPECT_EQ(to_string(TornEnd{.where = {.offset = 90, .bytes = 12}}), "the end is damaged: 12 bytes from byte 90 on are no record");
}

TEST(JournalSentence, SaysWhereAnotherProcessGoesOn) {
  EXPECT_EQ(to_string(messages::JournalResumed{.time = Time{5}, .cut_bytes = 17}),
            "another process goes on from here (earshotd --resume): the one before was killed or lost its power; 17 bytes that it left "
            "behind were cut off");
}

TEST(JournalSentence, SaysTheTroublesOfACanControllerAndTheirEnd) {
  using messages::ControllerState;
  const auto said = [](ControllerState trouble, bool is_there) {
    return to_string(messages::ControllerTrouble{.time = Time{5}, .port = 1, .trouble = trouble, .is_there = is_there});
  };
  EXPECT_EQ(said(ControllerState::kBusOff, true), "port 1: the CAN controller has left the bus after too many errors (bus-off)");
  EXPECT_EQ(said(ControllerState::kBusOff, false), "port 1: the CAN controller is back on the bus");
  EXPECT_EQ(said(ControllerState::kErrorPassive, false), "port 1: the CAN controller counts few errors");
}

}  // namespace
}  // namespace earshot::journal
