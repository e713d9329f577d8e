#include "firmware/boards/linux/journal_view/sentences.hpp"

#include <gtest/gtest.h>

#include "tests/firmware/boards/linux/journal_view/known_journal.hpp"

namespace earshot::journal_view {
namespace {

TEST(JournalSentence, SaysAMissionInKilometresAndWhoFlewIt) {
  EXPECT_EQ(
      to_string(known_mission()),
      "mission begins: area of 25.0 km x 20.0 km, at 300 m depth and 2.0 m/s, up to 100 steps of 1000 m in 60000 s; heard from 10.0 dB; "
      "flown by 0.1.0 abc");
}

TEST(JournalSentence, SpellsOutWhatABuildCouldSteerATerminalWith) {
  mission_t mission = known_mission();
  mission.build[0] = 0x1B;
  EXPECT_NE(to_string(mission).find("flown by \\x1b.1.0 abc"), std::string::npos) << to_string(mission);
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
  command_acknowledgement_t m{};
  m.command = 1;
  m.issuer = -1;
  m.outcome = command_acknowledgement_t::TOO_OLD;
  EXPECT_EQ(to_string(m), "order START, number 0 of issuer 4294967295: refused: too old");
  m.command = 99;
  m.outcome = 99;
  EXPECT_EQ(to_string(m), "order an unknown order, number 0 of issuer 4294967295: refused");
}

decision_t step_towards(double north_m, double east_m) {
  decision_t m{};
  m.snr_db = -3.25;
  m.waypoint_north_m = north_m;
  m.waypoint_east_m = east_m;
  return m;
}

// 600 and 800 are the sides of a right triangle of 1000; its angle from north is atan(800/600) = 53.13 degrees.
TEST(JournalSentence, SaysWhereADecisionGoes) {
  EXPECT_EQ(to_string(step_towards(600, 800)), "step 0: SNR -3.2 dB, not heard; from 0 m north, 0 m east goes 1000 m towards 053 deg");
  EXPECT_EQ(to_string(step_towards(-1000, 0)), "step 0: SNR -3.2 dB, not heard; from 0 m north, 0 m east goes 1000 m towards 180 deg");
  // 0.06 degrees west of north: 359.94, and no compass has 360.
  EXPECT_NE(to_string(step_towards(1000, -1)).find("towards 000 deg"), std::string::npos);
}

TEST(JournalSentence, SaysThatASignalWasTooFaintAndWhatIsBelieved) {
  decision_t m = step_towards(1000, 0);
  m.too_faint = 1;
  m.overridden = 1;
  m.believes = 1;
  m.likeliest_north_m = 12'345.6;
  m.likeliest_east_m = 6'000.0;
  m.mean_north_m = 9'000.0;
  m.spread_m = 890;
  EXPECT_EQ(to_string(m),
            "step 0: SNR below -3.2 dB, not heard; from 0 m north, 0 m east goes 1000 m towards 000 deg, as the safety layer changed it; "
            "the source is likeliest at 12346 m north, 6000 m east, the belief spread over 890 m");
}

TEST(JournalSentence, SaysFromWhereTheSourceWasHeardAndWhatItsMirrorImageIs) {
  decision_t m = step_towards(1000, 0);
  m.has_bearing = 1;
  m.bearing_rad = 0.8203;            // 47 degrees
  m.bearing_deviation_rad = 0.1745;  // 10 degrees
  EXPECT_EQ(to_string(m),
            "step 0: SNR -3.2 dB, not heard, from 47 deg, give or take 10 deg; from 0 m north, 0 m east goes 1000 m towards 000 deg");
  m.bearing_ambiguous = 1;
  m.bearing_axis_rad = 0.3491;  // 20 degrees: 2 x 20 - 47 = -7
  EXPECT_EQ(to_string(m),
            "step 0: SNR -3.2 dB, not heard, from 47 deg or 353 deg, give or take 10 deg; from 0 m north, 0 m east goes 1000 m towards "
            "000 deg");
}

TEST(JournalSentence, SaysWhoHoldsASearchBack) {
  health_t m{};
  m.state = health_t::SEARCH;
  m.authority = health_t::LISTEN;
  EXPECT_EQ(to_string(m, false), "SEARCH, listening: it commands nothing");
  m.authority = health_t::COMMAND;
  m.paused = 1;
  EXPECT_EQ(to_string(m, false), "SEARCH, paused by an operator");
  m.authority = health_t::DISCONNECTED;
  EXPECT_EQ(to_string(m, false), "SEARCH, the autopilot is not heard");
  m.end_reason = 4;
  m.state = health_t::ABORT;
  m.steps_taken = 12;
  EXPECT_EQ(to_string(m, false), "ABORT: navigation went silent, after 12 steps");
}

TEST(JournalSentence, SaysHowAJournalEndsAndWhatItLost) {
  wire::ClosingRecord closing{.time = kBegan, .ending = wire::Ending::kStopped, .state = messages::MissionState::kSearch, .steps_taken = 1};
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

}  // namespace
}  // namespace earshot::journal_view
