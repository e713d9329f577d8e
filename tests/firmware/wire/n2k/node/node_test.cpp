#include "firmware/wire/n2k/node/node.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "firmware/wire/n2k/node/information.hpp"
#include "firmware/wire/n2k/signals.hpp"
#include "firmware/wire/n2k/text.hpp"
#include "tests/firmware/wire/n2k/recorded_bus.hpp"

namespace earshot::n2k {
namespace {

constexpr std::uint8_t kOther = 0x23;

Identity identity() {
  Identity identity;
  identity.name = name_of({.unique_number = 4711}).value();
  identity.product = {
      .code = 7, .model = "Earshot", .software_version = "0.1", .model_version = "A", .serial = "4711", .load_equivalency = 0};
  identity.configuration = {.installation_1 = "stern", .installation_2 = "", .manufacturer = "us"};
  return identity;
}

Frame claim_of(Name name, std::uint8_t source) {
  Frame frame{.identifier = 0x18EEFF00U | source};
  for (unsigned i = 0; i < 8; ++i) frame.data[i] = static_cast<std::uint8_t>(name >> (8 * i));
  return frame;
}

/// The frame 18EAddss#pgn.
Frame request_of(std::uint32_t pgn, std::uint8_t destination = kBroadcast, std::uint8_t source = kOther) {
  Frame frame{.identifier = 0x18EA0000U | (std::uint32_t{destination} << 8U) | source, .size = 3};
  for (unsigned i = 0; i < 3; ++i) frame.data[i] = static_cast<std::uint8_t>(pgn >> (8 * i));
  return frame;
}

class NodeTest : public ::testing::Test {
 protected:
  std::vector<Frame> step(Duration later) {
    now_ = now_ + later;
    NodeFrames frames;
    node_.step(now_, frames);
    return {frames.begin(), frames.end()};
  }
  void accept(const Frame& frame) { node_.accept(frame, now_); }
  /// With an address, and after what it says of itself then.
  void settle() {
    (void)step(Duration{});
    (void)step(kClaimTime);
    (void)step(kLeastClaimGap);
    ASSERT_EQ(node_.address(), 0x40);
  }
  /// The messages of a group among the frames, put together.
  static std::vector<std::vector<std::uint8_t>> messages_of(std::uint32_t pgn, const std::vector<Frame>& frames) {
    std::vector<std::vector<std::uint8_t>> found;
    FastPacketAssembly assembly;
    for (const Frame& frame : frames) {
      const Identifier identifier = parse_identifier(frame.identifier).value();
      std::span<const std::uint8_t> bytes;
      if (identifier.pgn == pgn && assembly.accept(identifier, frame, bytes) == Status::kOk) found.emplace_back(bytes.begin(), bytes.end());
    }
    return found;
  }

  Time now_{1'000'000};
  Identity identity_ = identity();
  Node node_{identity_, table_pgns(PgnListKind::kTransmitted), table_pgns(PgnListKind::kReceived)};
};

TEST_F(NodeTest, ClaimsItsAddressAndWaitsBeforeItSaysMore) {
  EXPECT_EQ(step(Duration{}), std::vector{claim_of(identity_.name, 0x40)});
  accept(request_of(kProductPgn));
  EXPECT_TRUE(step(kClaimTime - Duration{1}).empty());
  EXPECT_FALSE(node_.address().has_value());
  const auto frames = step(Duration{1});
  EXPECT_EQ(node_.address(), 0x40);
  ASSERT_EQ(frames.size(), 2U);
  EXPECT_EQ(frames[0], request_of(kAddressClaimPgn, kBroadcast, 0x40));
  // Heartbeat: 126993 = 0x1F011 at priority 7; 60.000 s, sequence 0, controllers not available, operational (0).
  EXPECT_EQ(frames[1], (Frame{0x1DF01140, 8, {0x60, 0xEA, 0x00, 0xCF, 0xFF, 0xFF, 0xFF, 0xFF}}));
  EXPECT_EQ(step(kLeastClaimGap), std::vector{claim_of(identity_.name, 0x40)}) << "its own request is one to it, too";
}

TEST_F(NodeTest, DefendsItsAddressAgainstAHigherName) {
  settle();
  accept(claim_of(identity_.name + 1, 0x40));
  EXPECT_EQ(step(kLeastClaimGap), std::vector{claim_of(identity_.name, 0x40)});
  EXPECT_EQ(node_.address(), 0x40);
}

TEST_F(NodeTest, GivesWayToALowerNameAndTakesTheNextAddress) {
  settle();
  accept(claim_of(identity_.name - 1, 0x41));
  EXPECT_TRUE(step(kLeastClaimGap).empty());
  accept(claim_of(identity_.name - 2, 0x40));
  EXPECT_FALSE(node_.address().has_value());
  EXPECT_EQ(step(kLeastClaimGap), std::vector{claim_of(identity_.name, 0x42)}) << "0x41 is taken, too";
  (void)step(kClaimTime);
  EXPECT_EQ(node_.address(), 0x42);
}

TEST_F(NodeTest, SaysOnceThatNoAddressIsLeftAndTriesAgainLater) {
  settle();
  for (unsigned address = 0; address <= kLastAddress; ++address) accept(claim_of(1 + address, static_cast<std::uint8_t>(address)));
  EXPECT_EQ(step(kLongestCannotClaimDelay), std::vector{claim_of(identity_.name, kNullAddress)});
  accept(request_of(kProductPgn));
  EXPECT_TRUE(step(Duration::seconds(1)).empty());
  accept(request_of(kAddressClaimPgn));
  EXPECT_EQ(step(kLongestCannotClaimDelay), std::vector{claim_of(identity_.name, kNullAddress)});
  EXPECT_EQ(step(kClaimAgain), std::vector{claim_of(identity_.name, 0x40)});
  (void)step(kClaimTime);
  EXPECT_EQ(node_.address(), 0x40);
}

TEST_F(NodeTest, IsNotDisturbedByItsOwnEcho) {
  settle();
  accept(claim_of(identity_.name, 0x40));
  accept(claim_of(identity_.name, 0x99));
  EXPECT_TRUE(step(kLeastClaimGap).empty());
  EXPECT_EQ(node_.address(), 0x40);
  accept(request_of(kAddressClaimPgn, kBroadcast, 0x40));
  EXPECT_EQ(step(kLeastClaimGap), std::vector{claim_of(identity_.name, 0x40)});
}

TEST_F(NodeTest, AnswersWhoeverAsksForItsClaim) {
  settle();
  for (const std::uint8_t asker : std::initializer_list<std::uint8_t>{kOther, kNullAddress, kBroadcast}) {
    accept(request_of(kAddressClaimPgn, kBroadcast, asker));
    EXPECT_EQ(step(kLeastClaimGap), std::vector{claim_of(identity_.name, 0x40)});
    accept(request_of(kAddressClaimPgn, 0x40, asker));
    EXPECT_EQ(step(kLeastClaimGap), std::vector{claim_of(identity_.name, 0x40)});
  }
  accept(request_of(kAddressClaimPgn, 0x41));
  EXPECT_TRUE(step(kLeastClaimGap).empty()) << "somebody else is asked";
}

TEST_F(NodeTest, SaysWhatItIs) {
  settle();
  accept(request_of(kProductPgn));
  const auto found = messages_of(kProductPgn, step(kLeastAnswerGap));
  ASSERT_EQ(found.size(), 1U);
  ASSERT_EQ(found[0].size(), 134U);
  EXPECT_EQ(decode(table::field(table::kProduct, "NMEA2000Version"), found[0]).value(), 2.1);
  EXPECT_EQ(fixed_text(table::field(table::kProduct, "ModelID"), found[0]).value(), "Earshot");
  EXPECT_EQ(fixed_text(table::field(table::kProduct, "ModelSerialCode"), found[0]).value(), "4711");
}

TEST_F(NodeTest, SaysHowItIsInstalled) {
  settle();
  accept(request_of(kConfigurationPgn, 0x40));
  const auto found = messages_of(kConfigurationPgn, step(kLeastAnswerGap));
  ASSERT_EQ(found.size(), 1U);
  const std::vector<std::uint8_t> expected{7, 1, 's', 't', 'e', 'r', 'n', 2, 1, 4, 1, 'u', 's'};
  EXPECT_EQ(found[0], expected);
}

TEST_F(NodeTest, ListsWhatItSendsAndReads) {
  settle();
  accept(request_of(kPgnListPgn));
  const auto found = messages_of(kPgnListPgn, step(kLeastAnswerGap));
  ASSERT_EQ(found.size(), 2U);
  const auto lists = [&found](std::size_t which, std::uint32_t pgn) {
    for (std::size_t i = 1; i + 2 < found[which].size(); i += 3) {
      if ((found[which][i] | (found[which][i + 1] << 8) | (found[which][i + 2] << 16)) == static_cast<int>(pgn)) return true;
    }
    return false;
  };
  EXPECT_EQ(found[0][0], 0);
  EXPECT_TRUE(lists(0, 127237));
  EXPECT_FALSE(lists(0, 127250));
  EXPECT_EQ(found[1][0], 1);
  EXPECT_TRUE(lists(1, 127250));
  EXPECT_TRUE(lists(1, 129029));
  EXPECT_FALSE(lists(1, 127237));
}

TEST_F(NodeTest, RefusesWhatItDoesNotKnowWhenAskedAlone) {
  settle();
  accept(request_of(126'992));
  EXPECT_TRUE(step(kLeastAnswerGap).empty()) << "asked of all: who does not know keeps silent";
  accept(request_of(126'992, 0x40));
  // To 0x23 from 0x40: NAK (1), function not available, reserved, 126992 = 0x01F010.
  EXPECT_EQ(step(kLeastAnswerGap), (std::vector{Frame{0x18E82340, 8, {0x01, 0xFF, 0xFF, 0xFF, 0xFF, 0x10, 0xF0, 0x01}}}));
  // What it sends in its own time it does not send on request: 127237 = 0x01F105.
  accept(request_of(kHeadingControlPgn, 0x40));
  EXPECT_EQ(step(kLeastAnswerGap), (std::vector{Frame{0x18E82340, 8, {0x01, 0xFF, 0xFF, 0xFF, 0xFF, 0x05, 0xF1, 0x01}}}));
}

TEST_F(NodeTest, RefusesWhateverAGroupFunctionAsksOfItAlone) {
  settle();
  // Priority 3, 126208 = 0x1ED00, to 0x40 from 0x23: sequence 5, frame 0; 11 bytes; the function; the group, lowest byte first; parameters.
  const auto demand_of = [](std::uint8_t function, std::uint32_t pgn) {
    const auto byte = [pgn](unsigned i) { return static_cast<std::uint8_t>(pgn >> (8 * i)); };
    return Frame{0x0DED4023, 8, {0xA0, 11, function, byte(0), byte(1), byte(2), 0x10, 0x27}};
  };
  // To 0x23: acknowledges (2) the group with an error in the low four bits, none (0) in the high ones; no parameters.
  const auto refusal_of = [](std::uint8_t sequence, std::uint32_t pgn, std::uint8_t error) {
    const auto byte = [pgn](unsigned i) { return static_cast<std::uint8_t>(pgn >> (8 * i)); };
    const auto head = static_cast<std::uint8_t>(sequence * 32);
    return std::vector{Frame{0x0DED2340, 8, {head, 6, 2, byte(0), byte(1), byte(2), error, 0}}};
  };
  constexpr std::uint32_t kUnknown = 126'992;  // system time
  struct Row {
    std::uint8_t function;
    std::uint32_t pgn;
    std::uint8_t error;
  };
  std::uint8_t sequence = 0;
  for (const Row& row : {Row{0, kUnknown, 1}, Row{1, kUnknown, 1}, Row{0, kHeartbeatPgn, 4}, Row{1, kHeadingPgn, 4},
                         Row{3, kHeartbeatPgn, 6}, Row{5, kUnknown, 6}}) {
    accept(demand_of(row.function, row.pgn));
    EXPECT_EQ(step(kLeastAnswerGap), refusal_of(sequence++, row.pgn, row.error)) << int{row.function} << ' ' << row.pgn;
  }
  EXPECT_EQ(node_.counters().refused, 6U);
  for (const std::uint8_t function : std::initializer_list<std::uint8_t>{2, 4, 6, 7, 255}) accept(demand_of(function, kHeartbeatPgn));
  EXPECT_TRUE(step(kLeastAnswerGap).empty()) << "answers, and what nobody knows";
  Frame later = demand_of(0, kHeartbeatPgn);
  later.data[0] = 0xA1;
  accept(later);
  Frame small = demand_of(0, kHeartbeatPgn);
  small.data[1] = 5;
  accept(small);
  Frame cut = demand_of(0, kHeartbeatPgn);
  cut.size = 7;
  accept(cut);
  accept(demand_of(0, 0xFFFFFF));
  EXPECT_TRUE(step(kLeastAnswerGap).empty()) << "frames that begin no demand";
  Frame to_all = demand_of(0, kHeartbeatPgn);
  to_all.identifier = 0x0DEDFF23;
  accept(to_all);
  Frame to_another = demand_of(0, kHeartbeatPgn);
  to_another.identifier = 0x0DED4123;
  accept(to_another);
  EXPECT_TRUE(step(kLeastAnswerGap).empty()) << "asked of all, or of somebody else";
  for (int i = 0; i < 20; ++i) accept(demand_of(0, kUnknown));
  EXPECT_EQ(step(kLeastAnswerGap).size(), kWaitingAcknowledgements);
  EXPECT_EQ(node_.counters().unanswered, 20U - kWaitingAcknowledgements);
}

TEST_F(NodeTest, BeatsOnceAMinuteAndCountsTo252) {
  settle();
  (void)step(kHeartbeatPeriod - kLeastClaimGap - Duration{1});
  for (int i = 1; i <= 254; ++i) {
    EXPECT_TRUE(i > 1 ? step(kHeartbeatPeriod - Duration{1}).empty() : true);
    const auto frames = step(Duration{1});
    ASSERT_EQ(frames.size(), 1U);
    EXPECT_EQ(frames[0].data[2], i <= 252 ? i : i - 253);
  }
}

TEST_F(NodeTest, MovesToTheAddressItIsCommandedTo) {
  settle();
  // Announced to all by 0x23: 9 bytes in 2 packets of 65240; NAME, then address 0x55.
  const Frame announcement{0x1CECFF23, 8, {32, 9, 0, 2, 0xFF, 0xD8, 0xFE, 0x00}};
  Frame first{0x1CEBFF23, 8, {1}};
  for (unsigned i = 0; i < 7; ++i) first.data[i + 1] = static_cast<std::uint8_t>(identity_.name >> (8 * i));
  const Frame second{0x1CEBFF23, 8, {2, static_cast<std::uint8_t>(identity_.name >> 56U), 0x55, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF}};
  for (const Frame& frame : {first, second, announcement, second, announcement, first, first, second}) accept(frame);
  EXPECT_EQ(node_.address(), 0x40) << "without an announcement, or out of order";
  for (const Frame& frame : {announcement, first}) accept(frame);
  now_ = now_ + Duration::milliseconds(751);
  accept(second);
  EXPECT_EQ(node_.address(), 0x40) << "too late";
  Frame stranger = first;
  stranger.data[1] ^= 1U;
  for (const Frame& frame : {announcement, stranger, second}) accept(frame);
  EXPECT_EQ(node_.address(), 0x40) << "somebody else is meant";
  for (const Frame& frame : {announcement, first, second}) accept(frame);
  EXPECT_EQ(step(kLeastClaimGap)[0], claim_of(identity_.name, 0x55));
  (void)step(kClaimTime);
  EXPECT_EQ(node_.address(), 0x55);
  EXPECT_EQ(node_.counters().commanded, 1U);
}

TEST_F(NodeTest, BeatsWhenAskedButNoMoreOftenThanTenTimesASecond) {
  settle();
  accept(request_of(kHeartbeatPgn));
  EXPECT_EQ(step(kLeastAnswerGap - kLeastClaimGap).size(), 1U);
  EXPECT_TRUE(step(kLeastAnswerGap).empty()) << "one answer to one question";
  accept(request_of(kHeartbeatPgn, 0x40));
  EXPECT_EQ(step(Duration{}).size(), 1U);
  accept(request_of(kHeartbeatPgn));
  EXPECT_TRUE(step(kLeastAnswerGap - Duration{1}).empty());
  EXPECT_EQ(step(Duration{1}).size(), 1U);
  EXPECT_EQ(node_.counters().heartbeats, 4U) << "with the one at the start";
}

TEST_F(NodeTest, BeatsWithItsControllersStateOnceThatIsKnown) {
  settle();
  std::uint8_t sequence = 1;
  for (const auto& [state, expected] : {std::pair{ControllerState::kErrorActive, std::uint8_t{0xCC}},
                                        {ControllerState::kErrorPassive, std::uint8_t{0xCD}},
                                        {ControllerState::kBusOff, std::uint8_t{0xCE}}}) {
    node_.set_controller_state(state);
    accept(request_of(kHeartbeatPgn));
    EXPECT_EQ(step(kLeastAnswerGap), (std::vector{Frame{0x1DF01140, 8, {0x60, 0xEA, sequence++, expected, 0xFF, 0xFF, 0xFF, 0xFF}}}));
  }
}

TEST_F(NodeTest, AnswersEachQuestionOnceAndTheSameOneAgainAfterATenthOfASecond) {
  settle();
  accept(request_of(kConfigurationPgn));
  accept(request_of(kConfigurationPgn, 0x40));
  EXPECT_EQ(step(Duration{}).size(), 2U) << "13 bytes in two frames";
  EXPECT_TRUE(step(kLeastAnswerGap).empty());
  accept(request_of(kConfigurationPgn));
  const auto second = step(Duration{});
  ASSERT_EQ(second.size(), 2U);
  EXPECT_EQ(second[0].data[0], 0x20) << "its packet counts one higher than the first";
  accept(request_of(kConfigurationPgn));
  EXPECT_TRUE(step(kLeastAnswerGap - Duration{1}).empty());
  EXPECT_EQ(step(Duration{1}).size(), 2U);
  EXPECT_EQ(node_.counters().answers, 3U);
  EXPECT_EQ(node_.counters().requests, 4U);
}

TEST_F(NodeTest, RefusesEightThingsBetweenTwoStepsAndCountsTheRest) {
  settle();
  for (int i = 0; i < 11; ++i) accept(request_of(126'992, 0x40));
  EXPECT_EQ(step(kLeastAnswerGap).size(), 8U);
  EXPECT_TRUE(step(kLeastAnswerGap).empty());
  EXPECT_EQ(node_.counters().refused, 8U);
  EXPECT_EQ(node_.counters().unanswered, 3U);
  EXPECT_EQ(node_.counters().answers, 0U);
}

TEST_F(NodeTest, ForgetsWhatItWasAskedBeforeItLostItsAddress) {
  settle();
  accept(request_of(126'992, 0x40));
  accept({0x0DED4023, 8, {0xA0, 6, 0, 0x10, 0xF0, 0x01, 0, 0}});
  accept(claim_of(identity_.name - 1, 0x40));
  EXPECT_EQ(step(kLeastClaimGap), std::vector{claim_of(identity_.name, 0x41)});
  const auto frames = step(kClaimTime);
  ASSERT_EQ(frames.size(), 1U);
  EXPECT_EQ(frames[0], request_of(kAddressClaimPgn, kBroadcast, 0x41)) << "it asks anew who is there, and refuses nothing";
}

TEST_F(NodeTest, PutsNothingBehindWhatWasInItsCallersList) {
  settle();
  NodeFrames frames;
  ASSERT_EQ(frames.push_back(claim_of(1, 1)), Status::kOk);
  node_.step(now_, frames);
  EXPECT_TRUE(frames.empty());
}

TEST_F(NodeTest, SaysNothingMoreThoughItHearsAllThatItSaid) {
  settle();
  for (const std::uint32_t pgn : {kProductPgn, kConfigurationPgn, kPgnListPgn, kHeartbeatPgn}) accept(request_of(pgn));
  accept(request_of(126'992, 0x40));
  accept({0x0DED4023, 8, {0xA0, 6, 0, 0x10, 0xF0, 0x01, 0, 0}});
  std::vector<Frame> said;
  for (int i = 0; i < 3; ++i) {
    const auto frames = step(kLeastAnswerGap);
    said.insert(said.end(), frames.begin(), frames.end());
  }
  EXPECT_GT(said.size(), 40U);
  const std::uint64_t requests = node_.counters().requests;
  for (const Frame& frame : said) accept(frame);
  EXPECT_TRUE(step(kLeastAnswerGap).empty());
  EXPECT_EQ(node_.counters().requests, requests);
  EXPECT_EQ(node_.address(), 0x40);
}

TEST_F(NodeTest, CountsWhatBecameOfItsClaims) {
  settle();
  EXPECT_EQ(node_.claim_counters().claims, 2U) << "at its start, and when it asked who is there";
  accept(claim_of(identity_.name, 0x40));
  EXPECT_EQ(node_.claim_counters().own, 1U);
  accept(claim_of(identity_.name + 1, 0x40));
  EXPECT_EQ(node_.claim_counters().defended, 1U);
  accept(claim_of(identity_.name - 1, 0x40));
  EXPECT_EQ(node_.claim_counters().lost, 1U);
  for (unsigned address = 0; address <= kLastAddress; ++address) accept(claim_of(1 + address, static_cast<std::uint8_t>(address)));
  EXPECT_EQ(node_.claim_counters().given_up, 1U);
  EXPECT_EQ(node_.claim_counters().own, 1U);
  EXPECT_EQ(node_.claim_counters().defended, 1U);
}

TEST_F(NodeTest, DoesNotFillTheBusHoweverOftenItIsAsked) {
  settle();
  std::size_t sent = 0;
  for (int ms = 0; ms < 1000; ++ms) {
    for (const std::uint32_t pgn : {kAddressClaimPgn, kProductPgn, kConfigurationPgn, kPgnListPgn, kHeartbeatPgn}) accept(request_of(pgn));
    sent += step(Duration::milliseconds(1)).size();
  }
  // In a second at most 51 claims, 11 heartbeats and 11 of each answer; those take 20, 2 and 25 frames together.
  EXPECT_LE(sent, 51U + 11U + 11U * 47U);
  EXPECT_GE(node_.counters().answers, 30U);
}

}  // namespace
}  // namespace earshot::n2k
