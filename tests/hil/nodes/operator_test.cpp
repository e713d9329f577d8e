#include "hil/nodes/operator.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <optional>

#include "firmware/wire/n2k/own/challenge.hpp"
#include "firmware/wire/n2k/own/orders.hpp"
#include "firmware/wire/n2k/own/reports.hpp"
#include "firmware/wire/n2k/table/messages.hpp"
#include "tests/hil/nodes/listening.hpp"

namespace earshot::hil {
namespace {

using messages::CommandOutcome;
using messages::MissionState;
using messages::Order;

constexpr std::uint8_t kEarshot = 0x41;   ///< not the address that Earshot claims first
constexpr std::uint8_t kOperator = 0x29;  ///< the one that the operator claims first
constexpr Time kNoon{1'800'000'000'000'000};

/// Earshot's end: what it says, and what it takes of what the operator sends.
class OperatorTest : public testing::Test {
 protected:
  void pass(Duration duration) {
    for (const n2k::Frame& frame : run(*operator_, now_, now_ + duration)) {
      messages::OperatorCommand command;
      std::uint8_t sender = 0;
      if (receiver_.accept(frame, now_, kEarshot, command, sender) != Status::kOk) continue;
      EXPECT_EQ(sender, kOperator);
      EXPECT_EQ(n2k::parse_identifier(frame.identifier).value().destination, destination_);
      orders_.push_back(command);
    }
    now_ = now_ + duration;
  }

  void say(MissionState state) {
    n2k::FastPacketFrames packet;
    messages::Health health;
    health.state = state;
    ASSERT_EQ(n2k::compose_health(health, now_, {.source = kEarshot, .sequence = sequence_++}, packet), Status::kOk);
    for (const n2k::Frame& frame : packet) operator_->accept(frame, now_);
  }

  void answer(const messages::OperatorCommand& command, CommandOutcome outcome, std::uint8_t to = kOperator) {
    n2k::FastPacketFrames packet;
    const messages::CommandAcknowledgement acknowledgement{
        .time = now_, .port = 1, .issuer = command.issuer, .number = command.number, .order = command.order, .outcome = outcome};
    ASSERT_EQ(n2k::compose_acknowledgement(acknowledgement, {.source = kEarshot, .destination = to, .sequence = sequence_++}, packet),
              Status::kOk);
    for (const n2k::Frame& frame : packet) operator_->accept(frame, now_);
  }

  bool has_arrived_ = false;
  Time utc_ = kNoon;
  std::uint8_t destination_ = kEarshot;
  std::unique_ptr<Operator> operator_ = std::make_unique<Operator>(
      OperatorSetup{.issuer = 4711, .utc = [this] { return utc_; }, .has_arrived = [this] { return has_arrived_; }, .unique_number = 1});
  n2k::OrderReceiver receiver_;
  std::vector<messages::OperatorCommand> orders_;
  Time now_{};
  std::uint8_t sequence_ = 0;
};

TEST_F(OperatorTest, SaysNothingBeforeEarshotIsHeard) {
  pass(Duration::seconds(60));
  EXPECT_TRUE(orders_.empty());
}

TEST_F(OperatorTest, SaysStartToEarshotWhereverItIsDatedByTheWallClock) {
  say(MissionState::kStandby);
  pass(Duration::seconds(1));
  ASSERT_EQ(orders_.size(), 1U);
  EXPECT_EQ(orders_[0].order, Order::kStart);
  EXPECT_EQ(orders_[0].issuer, 4711U);
  EXPECT_EQ(orders_[0].time, kNoon);
  EXPECT_EQ(orders_[0].expiry, kNoon + Duration::seconds(30));
}

TEST_F(OperatorTest, RepeatsTheSameOrderOnceASecondUntilItIsAcknowledged) {
  say(MissionState::kStandby);
  pass(Duration::milliseconds(5500));
  ASSERT_EQ(orders_.size(), 6U) << "the first as soon as it has an address, a quarter of a second later";
  for (const messages::OperatorCommand& order : orders_) EXPECT_EQ(order, orders_[0]);
  answer(orders_[0], CommandOutcome::kObeyed);
  pass(Duration::seconds(60));
  EXPECT_EQ(orders_.size(), 6U);
  ASSERT_EQ(operator_->answers().size(), 1U);
  EXPECT_EQ(operator_->answers()[0].outcome, CommandOutcome::kObeyed);
}

TEST_F(OperatorTest, GivesAnOrderAnewOnceItHasExpiredByTheWallClock) {
  say(MissionState::kStandby);
  pass(Duration::seconds(100));
  EXPECT_EQ(orders_.back(), orders_.front()) << "the wall clock has not moved";
  utc_ = kNoon + Duration::seconds(30);
  pass(Duration::seconds(1));
  EXPECT_EQ(orders_.back(), orders_.front());
  utc_ = utc_ + Duration{1};
  pass(Duration::seconds(1));
  EXPECT_EQ(orders_.back().order, Order::kStart);
  EXPECT_EQ(orders_.back().number, orders_.front().number + 1);
  EXPECT_EQ(orders_.back().time, utc_);
}

TEST_F(OperatorTest, TakesNoAnswerThatIsAnothers) {
  say(MissionState::kStandby);
  pass(Duration::seconds(1));
  answer(orders_[0], CommandOutcome::kObeyed, kOperator + 1);
  messages::OperatorCommand other = orders_[0];
  other.issuer = 4712;
  answer(other, CommandOutcome::kObeyed);
  EXPECT_TRUE(operator_->answers().empty());
}

TEST_F(OperatorTest, CountsAnAnswerThatCameTwiceOnce) {
  say(MissionState::kStandby);
  pass(Duration::seconds(1));
  answer(orders_[0], CommandOutcome::kObeyed);
  answer(orders_[0], CommandOutcome::kObeyed);
  EXPECT_EQ(operator_->answers().size(), 1U);
}

TEST_F(OperatorTest, GivesARefusedStartAnewAfterFiveSeconds) {
  say(MissionState::kStandby);
  pass(Duration::seconds(1));
  answer(orders_[0], CommandOutcome::kTooOld);
  pass(Duration::seconds(5));
  EXPECT_EQ(orders_.size(), 1U);
  pass(Duration::milliseconds(100));
  ASSERT_EQ(orders_.size(), 2U);
  EXPECT_EQ(orders_[1].number, orders_[0].number + 1);
}

TEST_F(OperatorTest, SaysCompleteAtTheSourceInASearchAndOnlyThen) {
  has_arrived_ = true;
  say(MissionState::kStandby);
  pass(Duration::seconds(1));
  answer(orders_[0], CommandOutcome::kObeyed);
  pass(Duration::seconds(1));
  EXPECT_EQ(orders_.size(), 1U);
  has_arrived_ = false;
  say(MissionState::kSearch);
  pass(Duration::seconds(1));
  EXPECT_EQ(orders_.size(), 1U);
  has_arrived_ = true;
  pass(Duration::milliseconds(100));
  ASSERT_EQ(orders_.size(), 2U);
  EXPECT_EQ(orders_[1].order, Order::kComplete);
  answer(orders_[1], CommandOutcome::kObeyed);
  say(MissionState::kDone);
  pass(Duration::seconds(60));
  EXPECT_EQ(orders_.size(), 2U);
}

TEST_F(OperatorTest, GivesACompleteAnewThatHasExpiredAndNoStart) {
  say(MissionState::kStandby);
  pass(Duration::seconds(1));
  answer(orders_[0], CommandOutcome::kObeyed);
  has_arrived_ = true;
  say(MissionState::kSearch);
  pass(Duration::seconds(1));
  ASSERT_EQ(orders_.back().order, Order::kComplete);
  const messages::OperatorCommand first = orders_.back();
  utc_ = first.expiry + Duration{1};
  pass(Duration::seconds(1));
  EXPECT_EQ(orders_.back().order, Order::kComplete);
  EXPECT_EQ(orders_.back().number, first.number + 1);
  EXPECT_EQ(orders_.back().time, utc_);
  has_arrived_ = false;
  utc_ = orders_.back().expiry + Duration{1};
  const std::size_t given = orders_.size();
  pass(Duration::seconds(60));
  EXPECT_EQ(orders_.size(), given) << "nobody is at the source any more";
}

TEST_F(OperatorTest, StartsAnEarshotThatBeginsAgain) {
  say(MissionState::kStandby);
  pass(Duration::seconds(1));
  answer(orders_[0], CommandOutcome::kObeyed);
  say(MissionState::kAbort);
  say(MissionState::kStandby);
  pass(Duration::seconds(1));
  ASSERT_EQ(orders_.size(), 2U);
  EXPECT_EQ(orders_[1].order, Order::kStart);
}

TEST_F(OperatorTest, SaysCompleteToAnEarshotThatBeganAgainAndArrivedToo) {
  has_arrived_ = true;
  for (const std::size_t given : {0U, 2U}) {
    say(MissionState::kStandby);
    pass(Duration::seconds(1));
    ASSERT_EQ(orders_.size(), given + 1);
    EXPECT_EQ(orders_.back().order, Order::kStart);
    answer(orders_.back(), CommandOutcome::kObeyed);
    say(MissionState::kSearch);
    pass(Duration::milliseconds(500));
    ASSERT_EQ(orders_.size(), given + 2);
    EXPECT_EQ(orders_.back().order, Order::kComplete);
    answer(orders_.back(), CommandOutcome::kObeyed);
    say(MissionState::kDone);
  }
}

TEST_F(OperatorTest, GivesARefusedCompleteAnewAfterFiveSeconds) {
  has_arrived_ = true;
  say(MissionState::kSearch);
  pass(Duration::seconds(1));
  ASSERT_EQ(orders_.size(), 1U);
  ASSERT_EQ(orders_[0].order, Order::kComplete);
  answer(orders_[0], CommandOutcome::kTooOld);
  pass(Duration::seconds(5));
  EXPECT_EQ(orders_.size(), 1U);
  pass(Duration::milliseconds(100));
  ASSERT_EQ(orders_.size(), 2U);
  EXPECT_EQ(orders_[1].order, Order::kComplete);
  EXPECT_EQ(orders_[1].number, orders_[0].number + 1);
}

TEST_F(OperatorTest, AbortsInOneFrameToEveryoneWhileNobodyIsKnownToBeEarshot) {
  destination_ = n2k::kBroadcast;
  operator_->abort();
  operator_->abort();
  const Frames frames = of_group(n2k::kPeerPgn, run(*operator_, now_, now_ + Duration::milliseconds(500)));
  ASSERT_EQ(frames.size(), 1U);
  // 126720 = 0x1EF00 at priority 3 from 0x29 to all; maker and industry 0x9FFC, kind 3, issuer 4711 = 0x1267, number 1.
  EXPECT_EQ(frames[0], (n2k::Frame{0x0DEFFF29, 8, {0xFC, 0x9F, 0x03, 0x67, 0x12, 0x01, 0x00, 0x00}}));
}

TEST_F(OperatorTest, RepeatsAnAbortUntilItIsAnsweredHoweverLongThatTakes) {
  say(MissionState::kSearch);
  operator_->abort();
  utc_ = kNoon + Duration::seconds(120);
  pass(Duration::seconds(120));
  EXPECT_EQ(orders_.size(), 120U);
  answer(orders_.back(), CommandOutcome::kObeyed);
  pass(Duration::seconds(10));
  EXPECT_EQ(orders_.size(), 120U);
}

TEST_F(OperatorTest, WithAKeySaysNothingButAnAbortBeforeTheChallengeIsHeardAndThenMarksForIt) {
  // Stands for a key: a mark tells which challenge it was made for, and which order.
  const MakeMark mark = [](const messages::OperatorCommand& command, const messages::PublishedChallenge& told) {
    const bool is_meant = told.challenge.vehicle[0] == 'a';
    return is_meant ? std::optional(messages::CommandMark{told.challenge.nonce[0], static_cast<std::uint8_t>(command.order)})
                    : std::nullopt;
  };
  operator_ = std::make_unique<Operator>(OperatorSetup{
      .issuer = 4711, .utc = [this] { return utc_; }, .has_arrived = [this] { return has_arrived_; }, .unique_number = 1, .mark = mark});
  const auto publish_challenge = [this](std::uint8_t nonce, std::uint8_t vehicle) {
    n2k::FastPacketFrames packet;
    const messages::PublishedChallenge told{.time = now_, .challenge = {.nonce = {nonce}, .vehicle = {vehicle}}};
    ASSERT_EQ(n2k::compose_challenge(told, {.source = kEarshot, .sequence = sequence_++}, packet), Status::kOk);
    for (const n2k::Frame& frame : packet) operator_->accept(frame, now_);
  };
  say(MissionState::kStandby);
  pass(Duration::seconds(3));
  EXPECT_TRUE(orders_.empty());
  publish_challenge(9, 'b');
  pass(Duration::seconds(3));
  EXPECT_TRUE(orders_.empty()) << "of another vehicle";
  publish_challenge(9, 'a');
  pass(Duration::seconds(1));
  ASSERT_EQ(orders_.size(), 1U);
  EXPECT_EQ(orders_[0].mark, (messages::CommandMark{9, 1}));
  publish_challenge(10, 'a');
  pass(Duration::seconds(1));
  ASSERT_EQ(orders_.size(), 2U);
  EXPECT_EQ(orders_[1].mark, (messages::CommandMark{10, 1})) << "the vehicle began anew";
  operator_->abort();
  pass(Duration::seconds(1));
  EXPECT_TRUE(std::ranges::any_of(orders_, [](const messages::OperatorCommand& order) { return order.order == Order::kAbort; }));
}

TEST_F(OperatorTest, KeepsWhatEarshotSaysOfItself) {
  say(MissionState::kSearch);
  ASSERT_TRUE(operator_->health().has_value());
  EXPECT_EQ(operator_->health()->health.state, MissionState::kSearch);
  EXPECT_EQ(operator_->vehicle(), kEarshot);
}

}  // namespace
}  // namespace earshot::hil
