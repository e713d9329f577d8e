#include "hil/bench/lcm/bad_messages.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "earshot/nav_state_t.hpp"
#include "firmware/wire/lcm/channels.hpp"
#include "firmware/wire/lcm/encoding.hpp"
#include "tests/hil/seconds.hpp"
#include "tests/support/lcm_peer.hpp"

namespace earshot::hil {
namespace {

LcmMessage fix(double north_m) {
  nav_state_t fix{};
  fix.utime = 1'000'000;
  fix.north_m = north_m;
  return {.channel = std::string(wire::kNavStateChannel), .data = support::bytes_of(fix)};
}

/// Behind eight bytes of head, the channel's name and its zero.
nav_state_t read(const Datagram& datagram) {
  nav_state_t fix{};
  const std::size_t head = 8 + wire::kNavStateChannel.size() + 1;
  EXPECT_EQ(support::read_peer(std::span(datagram).subspan(head), fix), Status::kOk);
  return fix;
}

std::vector<double> norths(const std::vector<Datagram>& datagrams) {
  std::vector<double> norths;
  for (const Datagram& datagram : datagrams) norths.push_back(read(datagram).north_m);
  return norths;
}

using Norths = std::vector<double>;

class BadMessagesTest : public testing::Test {
 protected:
  std::vector<Datagram> pass(const LcmMessages& messages, const MessageAffliction& affliction, Time now = at_s(1)) {
    return bad_.pass(messages, {affliction}, now);
  }
  BadMessages bad_{1};
};

TEST_F(BadMessagesTest, LetsEverythingPassInItsOrderWithoutAFault) {
  EXPECT_EQ(norths(bad_.pass({fix(1), fix(2)}, {}, at_s(1))), (Norths{1, 2}));
  EXPECT_EQ(bad_.afflicted(), 0U);
}

TEST_F(BadMessagesTest, LosesThoseOfWhomTheFaultNamesAndNoOthers) {
  EXPECT_TRUE(pass({fix(1)}, {.fault = Fault::kLoss, .sender = "navigation"}).empty());
  EXPECT_EQ(norths(pass({fix(1)}, {.fault = Fault::kLoss, .sender = "hydrophone"})), Norths{1});
  EXPECT_EQ(bad_.afflicted(), 1U);
}

TEST_F(BadMessagesTest, DelaysAndReplaysByTheirSeconds) {
  EXPECT_TRUE(pass({fix(1)}, {.fault = Fault::kDelay, .seconds = Duration::seconds(2)}).empty());
  EXPECT_EQ(norths(pass({fix(2)}, {.fault = Fault::kReplay, .seconds = Duration::seconds(1)}, at_s(2))), Norths{2});
  EXPECT_EQ(norths(bad_.pass({fix(3)}, {}, at_s(3))), (Norths{1, 2, 3}));
}

TEST_F(BadMessagesTest, FlipsOneBitOfADatagramAndCutsItInHalf) {
  const Datagram whole = BadMessages(1).pass({fix(1)}, {}, at_s(1)).at(0);
  const Datagram flipped = pass({fix(1)}, {.fault = Fault::kCorruption}).at(0);
  ASSERT_EQ(flipped.size(), whole.size());
  int bits = 0;
  for (std::size_t i = 0; i < whole.size(); ++i) bits += std::popcount(static_cast<unsigned>(whole[i] ^ flipped[i]));
  EXPECT_EQ(bits, 1);
  EXPECT_EQ(pass({fix(1)}, {.fault = Fault::kTruncation}).at(0).size(), whole.size() / 2);
}

TEST_F(BadMessagesTest, MakesEveryNumberNaNAndLeavesTheDate) {
  const nav_state_t read_fix = read(pass({fix(1)}, {.fault = Fault::kNotAvailable}).at(0));
  EXPECT_TRUE(std::isnan(read_fix.north_m) && std::isnan(read_fix.depth_m) && std::isnan(read_fix.heading_rad));
  EXPECT_EQ(read_fix.utime, 1'000'000);
}

TEST_F(BadMessagesTest, DatesAMessageAheadAndBehind) {
  EXPECT_EQ(read(pass({fix(1)}, {.fault = Fault::kDateError, .seconds = Duration::seconds(60)}).at(0)).utime, 61'000'000);
  EXPECT_EQ(read(pass({fix(1)}, {.fault = Fault::kDateError, .seconds = Duration::seconds(-3600)}).at(0)).utime, -3'599'000'000);
}

template <class Message>
LcmMessage told(const Message& message) {
  const wire::Encoded encoded(message, Time{1'000'000});
  return {.channel = std::string(wire::channel_of<Message>), .data = {encoded.bytes().begin(), encoded.bytes().end()}};
}

/// What a fault did to one message: it counts it, or lets it pass as it is.
template <class Message>
bool is_afflicted(const Message& message, const MessageAffliction& affliction) {
  const LcmMessage sent = told(message);
  BadMessages bad(1);
  const std::vector<Datagram> arrived = bad.pass({sent}, {affliction}, at_s(1));
  const bool is_another = arrived != BadMessages(1).pass({sent}, {}, at_s(1));
  EXPECT_EQ(bad.afflicted(), is_another ? 1U : 0U) << sent.channel;
  return is_another;
}

TEST_F(BadMessagesTest, DatesEveryMessageThatBearsADate) {
  const MessageAffliction ahead{.fault = Fault::kDateError, .seconds = Duration::seconds(60)};
  EXPECT_TRUE(is_afflicted(messages::BearingMeasurement{}, ahead));
  EXPECT_TRUE(is_afflicted(messages::OperatorCommand{}, ahead));
  EXPECT_TRUE(is_afflicted(messages::Setpoint{}, ahead));
  EXPECT_TRUE(is_afflicted(messages::Decision{}, ahead));
  EXPECT_TRUE(is_afflicted(messages::SafetyEvent{}, ahead));
  EXPECT_TRUE(is_afflicted(messages::Health{}, ahead));
  EXPECT_TRUE(is_afflicted(messages::CommandAcknowledgement{}, ahead));
  EXPECT_TRUE(is_afflicted(messages::PublishedChallenge{}, ahead));
  EXPECT_TRUE(is_afflicted(messages::SoundDetection{}, ahead));
  EXPECT_FALSE(is_afflicted(messages::PortReport{}, ahead)) << "it bears none";
}

TEST_F(BadMessagesTest, CountsNoMessageThatHasNoNumberToLose) {
  const MessageAffliction lost{.fault = Fault::kNotAvailable};
  EXPECT_TRUE(is_afflicted(messages::BearingMeasurement{}, lost));
  EXPECT_TRUE(is_afflicted(messages::Decision{}, lost)) << "also without a bearing and a belief";
  EXPECT_TRUE(is_afflicted(messages::Health{}, lost));
  EXPECT_TRUE(is_afflicted(messages::SafetyEvent{}, lost));
  EXPECT_FALSE(is_afflicted(messages::AutopilotStatus{}, lost));
  EXPECT_FALSE(is_afflicted(messages::CommandAcknowledgement{}, lost));
}

TEST_F(BadMessagesTest, CountsNoMessageOfAStrangersChannelThatItCannotRead) {
  const LcmMessage strange{.channel = "SOMEBODY_ELSES_CAMERA", .data = std::vector<std::uint8_t>(64, 0x55)};
  EXPECT_EQ(pass({strange}, {.fault = Fault::kNotAvailable}).size(), 1U);
  EXPECT_EQ(pass({strange}, {.fault = Fault::kDateError, .seconds = Duration::seconds(60)}).size(), 1U);
  EXPECT_EQ(bad_.afflicted(), 0U);
}

TEST_F(BadMessagesTest, MakesEveryFaultThatMessagesCanHaveAndRefusesTheOthers) {
  for (const FaultTraits& traits : kFaultTraits) {
    BadMessages bad(1);
    const bool is_messages = traits.hits == FaultTarget::kFrames && traits.bus != FaultBus::kCan;
    const auto pass = [&] { (void)bad.pass({fix(1)}, {{.fault = traits.fault, .seconds = Duration::seconds(1)}}, at_s(1)); };
    if (!is_messages) {
      EXPECT_THROW(pass(), NoMaker) << traits.word;
      continue;
    }
    EXPECT_NO_THROW(pass()) << traits.word;
    EXPECT_EQ(bad.afflicted(), 1U) << traits.word;
  }
}

TEST_F(BadMessagesTest, KnowsWhoseEveryMessageIs) {
  EXPECT_EQ(sender_on(wire::kBearingChannel), "hydrophone");
  EXPECT_EQ(sender_on(wire::kHydrophoneStatusChannel), "hydrophone");
  EXPECT_EQ(sender_on(wire::kVehicleStatusChannel), "vehicle-status");
  EXPECT_EQ(sender_on(wire::kAutopilotStatusChannel), "autopilot");
  for (const std::string_view own : {wire::kSetpointChannel, wire::kDecisionChannel, wire::kHealthChannel, wire::kAcknowledgementChannel,
                                     wire::kChallengeChannel, wire::kSafetyEventChannel, wire::kDetectionChannel})
    EXPECT_EQ(sender_on(own), "earshot") << own;
  EXPECT_EQ(sender_on(wire::kOperatorCommandChannel), "") << "it is no device of the vehicle's";
}

TEST_F(BadMessagesTest, LetsMessagesOfOneTurnChangePlacesAndLosesNone) {
  bool has_changed = false;
  for (int i = 0; i < 20; ++i) {
    Norths arrived = norths(pass({fix(1), fix(2), fix(3)}, {.fault = Fault::kReordering}));
    has_changed = has_changed || arrived != Norths{1, 2, 3};
    std::ranges::sort(arrived);
    EXPECT_EQ(arrived, (Norths{1, 2, 3}));
  }
  EXPECT_TRUE(has_changed);
}

TEST_F(BadMessagesTest, ArrivesOnceMoreForEveryDuplicationAndNeverWhenItIsLost) {
  const MessageAffliction twice{.fault = Fault::kDuplication};
  EXPECT_EQ(BadMessages(1).pass({fix(1)}, std::vector(40, twice), at_s(1)).size(), 41U);
  EXPECT_EQ(BadMessages(1).pass({fix(1)}, {{.fault = Fault::kLoss}, twice}, at_s(1)).size(), 0U);
}

TEST_F(BadMessagesTest, LetsLateMessagesChangePlacesWithThoseOfTheirArrival) {
  bool has_overtaken = false;
  for (int i = 0; i < 20; ++i) {
    BadMessages messages(static_cast<std::uint64_t>(i));
    const MessageAffliction shuffled{.fault = Fault::kReordering};
    (void)messages.pass({fix(1)}, {{.fault = Fault::kDelay, .seconds = Duration::seconds(1)}, shuffled}, at_s(1));
    const Norths arrived = norths(messages.pass({fix(2)}, {shuffled}, at_s(2)));
    ASSERT_EQ(arrived.size(), 2U);
    has_overtaken = has_overtaken || arrived == Norths{2, 1};
  }
  EXPECT_TRUE(has_overtaken);
}

TEST_F(BadMessagesTest, HitsItsShareAndTheSameOnesWithTheSameSeed) {
  const LcmMessages many(1000, fix(1));
  const MessageAffliction half{.fault = Fault::kLoss, .share = 0.5};
  const std::vector<Datagram> arrived = pass(many, half);
  EXPECT_NEAR(static_cast<double>(arrived.size()), 500.0, 80.0) << "five standard deviations of 16";
  EXPECT_EQ(arrived.size(), BadMessages(1).pass(many, {half}, at_s(1)).size());
}

}  // namespace
}  // namespace earshot::hil
