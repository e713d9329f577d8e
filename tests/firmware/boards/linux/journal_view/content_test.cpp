#include "firmware/boards/linux/journal_view/content.hpp"

#include <gtest/gtest.h>

#include <array>

#include "earshot/controller_trouble_t.hpp"
#include "earshot/journal_resumed_t.hpp"
#include "earshot/setpoint_t.hpp"
#include "firmware/boards/linux/journal_view/export/fields.hpp"
#include "firmware/boards/linux/journal_view/sentences.hpp"
#include "firmware/wire/lcm/encoding.hpp"
#include "tests/firmware/boards/linux/journal_view/known_journal.hpp"
#include "tests/support/lcm_peer.hpp"

namespace earshot::journal_view {
namespace {

Content content_of_message(std::string_view channel, const auto& message) {
  return content_of(channel, kBegan, support::bytes_of(message));
}

TEST(JournalContent, TellsAnInputWithItsPortAndArrival) {
  const Content content = content_of("EARSHOT_NAV_STATE.3", kBegan, wire::Encoded(known_fix(after(5))).bytes());
  const auto& input = std::get<messages::Input>(content);
  EXPECT_EQ(input.port, 3);
  EXPECT_EQ(input.arrival, kBegan);
  EXPECT_EQ(std::get<messages::Navigation>(input.value), known_fix(after(5)));
}

TEST(JournalContent, KnowsAPolicyByItsChecksum) {
  const Content content = content_of("EARSHOT_POLICY", kBegan, kPolicy);
  EXPECT_EQ(std::get<PolicyBytes>(content).size, 3U);
  EXPECT_EQ(std::get<PolicyBytes>(content).crc32, kPolicyCrc);
}

TEST(JournalContent, ReadsASetpointThatWasJournalledAndNoneOfABus) {
  const auto message = support::as_peer<setpoint_t>(some_setpoint(), kBegan);
  EXPECT_EQ(std::get<messages::Setpoint>(content_of_message("EARSHOT_SETPOINT.0", message)).depth, Meters{300});
  EXPECT_FALSE(std::get<Unreadable>(content_of_message("EARSHOT_SETPOINT", message)).is_known_channel);
}

TEST(JournalContent, TellsAMessageOfAnotherVersionFromAnUnknownChannel) {
  constexpr std::array<std::uint8_t, 12> kBytes{1, 2, 3};
  for (const char* channel : {"EARSHOT_NAV_STATE.1", "EARSHOT_HEALTH", "EARSHOT_MISSION", "EARSHOT_DECISION", "EARSHOT_SAFETY_EVENT",
                              "EARSHOT_COMMAND_ACKNOWLEDGEMENT", "EARSHOT_JOURNAL_END", "EARSHOT_SETPOINT.0"})
    EXPECT_TRUE(std::get<Unreadable>(content_of(channel, kBegan, kBytes)).is_known_channel) << channel;
  EXPECT_FALSE(std::get<Unreadable>(content_of("SOMEBODY_ELSES", kBegan, kBytes)).is_known_channel);
  EXPECT_FALSE(std::get<Unreadable>(content_of("", kBegan, {})).is_known_channel);
}

TEST(JournalContent, ReadsWhereAnotherProcessGoesOn) {
  const journal_resumed_t resumed{.utime = 5, .cut_bytes = 17, .build = {'0', '.', '1'}};
  const Content content = content_of("EARSHOT_JOURNAL_RESUMED", kBegan, support::bytes_of(resumed));
  EXPECT_EQ(to_string(std::get<messages::JournalResumed>(content)),
            "another process goes on from here (earshotd --resume): the one before was killed or lost its power; 17 bytes that it left "
            "behind were cut off");
  EXPECT_STREQ(topic_of(content), "journal_resumed");
  EXPECT_EQ(fields_of(content).dump(), R"({"cut_bytes":17,"build":"0.1"})");
}

TEST(JournalContent, ReadsTheTroublesOfACanController) {
  controller_trouble_t trouble{.utime = 5, .port = 1, .trouble = controller_trouble_t::BUS_OFF, .is_there = 1};
  const Content content = content_of("EARSHOT_CONTROLLER_TROUBLE", kBegan, support::bytes_of(trouble));
  EXPECT_EQ(to_string(std::get<messages::ControllerTrouble>(content)),
            "port 1: the CAN controller has left the bus after too many errors (bus-off)");
  EXPECT_STREQ(topic_of(content), "controller_trouble");
  EXPECT_EQ(fields_of(content).dump(), R"({"port":1,"trouble":"bus off","is_there":true})");
  trouble.is_there = 0;
  EXPECT_EQ(to_string(support::from_peer<messages::ControllerTrouble>(trouble)), "port 1: the CAN controller is back on the bus");
  trouble.trouble = controller_trouble_t::ERROR_PASSIVE;
  EXPECT_EQ(to_string(support::from_peer<messages::ControllerTrouble>(trouble)), "port 1: the CAN controller counts few errors");
}

TEST(JournalContent, ReadsTheClosingRecord) {
  const messages::ClosingRecord closing{.time = kBegan, .ending = messages::Ending::kClockLost, .steps_taken = 3};
  EXPECT_EQ(std::get<messages::ClosingRecord>(content_of("EARSHOT_JOURNAL_END", kBegan, wire::Encoded(closing).bytes())), closing);
}

}  // namespace
}  // namespace earshot::journal_view
