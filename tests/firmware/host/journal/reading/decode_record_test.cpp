#include "firmware/host/journal/reading/decode_record.hpp"

#include <gtest/gtest.h>

#include <array>

#include "earshot/controller_trouble_t.hpp"
#include "earshot/journal_resumed_t.hpp"
#include "earshot/setpoint_t.hpp"
#include "firmware/wire/lcm/encoding.hpp"
#include "tests/firmware/host/journal/known_journal.hpp"
#include "tests/support/lcm_peer.hpp"

namespace earshot::journal {
namespace {

Content decoded(std::string_view channel, const auto& message) {
  return decode_record(channel, kBegan, support::bytes_of(message));
}

TEST(DecodeRecord, TellsAnInputWithItsPortAndArrival) {
  const Content content = decode_record("EARSHOT_NAV_STATE.3", kBegan, wire::Encoded(known_fix(after(5))).bytes());
  const auto& input = std::get<messages::Input>(content);
  EXPECT_EQ(input.port, 3);
  EXPECT_EQ(input.arrival, kBegan);
  EXPECT_EQ(std::get<messages::Navigation>(input.value), known_fix(after(5)));
}

TEST(DecodeRecord, KnowsAPolicyByItsChecksum) {
  const Content content = decode_record("EARSHOT_POLICY", kBegan, kPolicy);
  EXPECT_EQ(std::get<PolicyBytes>(content).bytes, (std::vector<std::uint8_t>{1, 2, 3}));
  EXPECT_EQ(std::get<PolicyBytes>(content).crc32, kPolicyCrc);
}

TEST(DecodeRecord, ReadsASetpointThatWasJournalledAndNoneOfABus) {
  const auto message = support::as_peer<setpoint_t>(some_setpoint(), kBegan);
  EXPECT_EQ(std::get<messages::Setpoint>(decoded("EARSHOT_SETPOINT.0", message)).depth, Meters{300});
  EXPECT_FALSE(std::get<Unreadable>(decoded("EARSHOT_SETPOINT", message)).is_known_channel);
}

TEST(DecodeRecord, ReadsWhatOnlyALogOfABusHas) {
  const messages::SoundDetection sound{.begin = Time{5}, .duration = Duration{6}, .level = Decibels{101.5}, .snr = Decibels{12.5}};
  EXPECT_EQ(std::get<messages::SoundDetection>(decode_record("EARSHOT_DETECTION", kBegan, wire::Encoded(sound).bytes())), sound);
  messages::PublishedChallenge published;
  published.time = Time{5};
  published.challenge.vehicle = {'a', 'u', 'v'};
  EXPECT_EQ(std::get<messages::PublishedChallenge>(decode_record("EARSHOT_CHALLENGE", kBegan, wire::Encoded(published).bytes())),
            published);
}

TEST(DecodeRecord, TellsAMessageOfAnotherVersionFromAnUnknownChannel) {
  constexpr std::array<std::uint8_t, 12> kBytes{1, 2, 3};
  for (const char* channel : {"EARSHOT_NAV_STATE.1", "EARSHOT_HEALTH", "EARSHOT_MISSION", "EARSHOT_DECISION", "EARSHOT_SAFETY_EVENT",
                              "EARSHOT_COMMAND_ACKNOWLEDGEMENT", "EARSHOT_JOURNAL_END", "EARSHOT_SETPOINT.0"})
    EXPECT_TRUE(std::get<Unreadable>(decode_record(channel, kBegan, kBytes)).is_known_channel) << channel;
  EXPECT_FALSE(std::get<Unreadable>(decode_record("SOMEBODY_ELSES", kBegan, kBytes)).is_known_channel);
  EXPECT_FALSE(std::get<Unreadable>(decode_record("", kBegan, {})).is_known_channel);
}

TEST(DecodeRecord, ReadsWhereAnotherProcessGoesOn) {
  const journal_resumed_t resumed{.utime = 5, .cut_bytes = 17, .build = {'0', '.', '1'}};
  const Content content = decode_record("EARSHOT_JOURNAL_RESUMED", kBegan, support::bytes_of(resumed));
  EXPECT_EQ(std::get<messages::JournalResumed>(content).cut_bytes, 17U);
  EXPECT_EQ(messages::text_of(std::get<messages::JournalResumed>(content).build), "0.1");
}

TEST(DecodeRecord, ReadsTheTroublesOfACanController) {
  const controller_trouble_t trouble{.utime = 5, .port = 1, .trouble = controller_trouble_t::BUS_OFF, .is_there = 1};
  const messages::ControllerTrouble expected{.time = Time{5}, .port = 1, .trouble = messages::ControllerState::kBusOff, .is_there = true};
  EXPECT_EQ(std::get<messages::ControllerTrouble>(decode_record("EARSHOT_CONTROLLER_TROUBLE", kBegan, support::bytes_of(trouble))),
            expected);
}

TEST(DecodeRecord, ReadsTheClosingRecord) {
  const messages::ClosingRecord closing{.time = kBegan, .ending = messages::Ending::kClockLost, .steps_taken = 3};
  EXPECT_EQ(std::get<messages::ClosingRecord>(decode_record("EARSHOT_JOURNAL_END", kBegan, wire::Encoded(closing).bytes())), closing);
}

}  // namespace
}  // namespace earshot::journal
