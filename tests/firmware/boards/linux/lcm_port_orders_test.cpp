// lcm_port.cpp: what it makes of orders, readable or not.

#include <gtest/gtest.h>

#include <cstdint>
#include <map>
#include <optional>
#include <string_view>
#include <vector>

#include "earshot/challenge_t.hpp"
#include "earshot/command_acknowledgement_t.hpp"
#include "firmware/boards/linux/lcm_port.hpp"
#include "firmware/wire/lcm/channels.hpp"
#include "firmware/wire/lcm/encoding.hpp"
#include "tests/firmware/boards/linux/set_clock.hpp"
#include "tests/support/lcm_peer.hpp"
#include "tests/support/private_network.hpp"

namespace earshot::board {
namespace {

using host::Role;
using messages::Order;
using Bytes = std::vector<std::uint8_t>;

constexpr const char* kOrdersUrl = "udpm://239.255.76.67:7667?ttl=0";

class OrderSink final : public InputSink {
 public:
  void take(std::uint8_t /*port*/, const Value& value) override {
    if (const auto* command = std::get_if<messages::OperatorCommand>(&value)) commands.push_back(*command);
  }
  void report_order_trouble(std::uint8_t /*port*/, OrderTrouble trouble) override { ++troubles[trouble]; }
  std::vector<messages::OperatorCommand> commands;
  std::map<OrderTrouble, int> troubles;
};

class LcmPortOrders : public testing::Test {
 protected:
  void SetUp() override {
    ENTER_PRIVATE_NETWORK_OR_SKIP();
    port_.emplace(std::uint8_t{1}, settings_);
    ashore_.emplace(host::parse_lcm_url(kOrdersUrl), std::vector{wire::kAcknowledgementChannel});
  }

  static Bytes bytes_of(const messages::OperatorCommand& command) {
    const wire::Encoded encoded(command);
    return {encoded.bytes().begin(), encoded.bytes().end()};
  }
  static messages::OperatorCommand command(Order order, std::uint32_t number) {
    return {.time = Time{1'795'000'000'000'000}, .expiry = Time{1'795'000'060'000'000}, .issuer = 4711, .number = number, .order = order};
  }
  void send(const Bytes& bytes) { ASSERT_EQ(ashore_->publish(wire::kOperatorCommandChannel, bytes), Status::kOk); }
  std::vector<command_acknowledgement_t> answers() {
    std::vector<command_acknowledgement_t> answers;
    ashore_->collect();
    for (wire::Lc02Message message; ashore_->take(message) == Status::kOk;) {
      if (support::read_peer(message.data, answers.emplace_back()) != Status::kOk) ADD_FAILURE() << message.channel;
    }
    return answers;
  }

  const host::PortSettings settings_{.name = "vehicle", .address = kOrdersUrl, .roles = {Role::kOperator}};
  std::optional<LcmPort> port_;
  std::optional<host::LcmEndpoint> ashore_;
  SetClock clock_;
  OrderSink sink_;
};

// What PyPI's lcm-gen makes of an order whose `mark` nobody set: its 16 bytes are missing. Five such ABORTs were ignored without a word.
TEST_F(LcmPortOrders, TakesAnAbortWhoseMarkIsMissingAndSaysSo) {
  Bytes bytes = bytes_of(command(Order::kAbort, 3));
  bytes.erase(bytes.begin() + 57, bytes.begin() + 73);
  send(bytes);
  port_->collect(clock_, sink_);
  ASSERT_EQ(sink_.commands.size(), 1U);
  EXPECT_EQ(sink_.commands[0].order, Order::kAbort);
  EXPECT_EQ(sink_.commands[0].issuer, 4711U) << "it is acknowledged to its sender";
  EXPECT_EQ(sink_.commands[0].number, 3U);
  EXPECT_EQ(sink_.troubles, (std::map<OrderTrouble, int>{{OrderTrouble::kCutAbort, 1}}));
  EXPECT_EQ(port_->report().malformed, 0U);
}

TEST_F(LcmPortOrders, KeepsAnAbortThatIsCutHoweverManyOrdersComeBehindIt) {
  Bytes bytes = bytes_of(command(Order::kAbort, 3));
  bytes.resize(40);
  send(bytes);
  for (std::uint32_t number = 4; number < 20; ++number) send(bytes_of(command(Order::kPause, number)));
  port_->collect(clock_, sink_);
  ASSERT_FALSE(sink_.commands.empty());
  EXPECT_EQ(sink_.commands[0].order, Order::kAbort);
}

TEST_F(LcmPortOrders, AnswersAnOrderThatItCannotReadWithTheReason) {
  Bytes bytes = bytes_of(command(Order::kStart, 3));
  bytes.erase(bytes.begin() + 57, bytes.begin() + 73);
  send(bytes);
  send({1, 2, 3});
  port_->collect(clock_, sink_);
  EXPECT_TRUE(sink_.commands.empty()) << "nobody starts by half an order";
  EXPECT_EQ(sink_.troubles, (std::map<OrderTrouble, int>{{OrderTrouble::kUnreadable, 2}}));
  EXPECT_EQ(port_->report().malformed, 2U);
  const std::vector<command_acknowledgement_t> told = answers();
  ASSERT_EQ(told.size(), 2U);
  EXPECT_EQ(told[0].issuer, 4711);
  EXPECT_EQ(told[0].number, 3);
  EXPECT_EQ(told[0].command, static_cast<int>(Order::kStart));
  EXPECT_EQ(told[0].outcome, static_cast<int>(messages::CommandOutcome::kUnreadable));
  EXPECT_EQ(told[0].utime, clock_.time.us);
  EXPECT_EQ(told[1].issuer, 0) << "nobody knows whose it was";
  EXPECT_EQ(told[1].outcome, static_cast<int>(messages::CommandOutcome::kUnreadable));
}

TEST_F(LcmPortOrders, AnswersNoMoreUnreadableOrdersInATurnThanItAnswersOthers) {
  for (int round = 0; round < 10; ++round) {
    for (int i = 0; i < 4; ++i) send({1, 2, 3});  // as many as wait in the queue of one channel
    port_->collect(clock_, sink_);
  }
  EXPECT_EQ(sink_.troubles[OrderTrouble::kUnreadable], 40);
  std::size_t answered = 0;
  for (std::size_t more = answers().size(); more > 0; more = answers().size()) answered += more;
  EXPECT_LE(answered, config::kMaxAcknowledgements);
  EXPECT_GT(answered, 0U);
  port_->publish(clock_.time, {});
  send({1, 2, 3});
  port_->collect(clock_, sink_);
  EXPECT_EQ(answers().size(), 1U) << "in the next turn again";
}

host::CommandProof proof_of(std::string_view vehicle, bool accepts_old_marks = false) {
  return {
      .key = host::CommandKey(host::KeyBytes{7}), .challenge = host::new_challenge(vehicle, {}), .accepts_old_marks = accepts_old_marks};
}

/// A vehicle whose mission names a key, and what it makes of one order.
class LcmPortMarks : public LcmPortOrders {
 protected:
  struct Found {
    bool is_verified = false;
    bool has_old_mark = false;
    std::map<OrderTrouble, int> troubles;
  };
  static LcmPort vehicle(const host::CommandProof& proof) {
    return {1, {.name = "vehicle", .address = kOrdersUrl, .roles = {Role::kOperator}, .command_proof = proof}};
  }
  Found hear(LcmPort& port, const Bytes& bytes) {
    OrderSink sink;
    send(bytes);
    port.collect(clock_, sink);
    EXPECT_EQ(sink.commands.size(), 1U);
    if (sink.commands.empty()) return {};
    return {.is_verified = sink.commands[0].is_verified, .has_old_mark = sink.commands[0].has_old_mark, .troubles = sink.troubles};
  }
  /// What a vehicle says that orders are to be marked for.
  messages::PublishedChallenge published_by(LcmPort& port) {
    host::LcmEndpoint ashore(host::parse_lcm_url(kOrdersUrl), {wire::kChallengeChannel});
    port.publish(clock_.time, {});
    ashore.collect();
    challenge_t message{};
    wire::Lc02Message heard;
    EXPECT_EQ(ashore.take(heard), Status::kOk);
    EXPECT_EQ(support::read_peer(heard.data, message), Status::kOk);
    return support::from_peer<messages::PublishedChallenge>(message);
  }
  const host::CommandKey key_{host::KeyBytes{7}};
};

TEST_F(LcmPortMarks, OfAStartThatWasRecordedStartNeitherAnotherVehicleNorTheSameBegunAnew) {
  LcmPort vehicle_a = vehicle(proof_of("a"));
  const messages::PublishedChallenge told = published_by(vehicle_a);
  EXPECT_TRUE(key_.verifies(told));
  EXPECT_EQ(told.time, clock_.time);
  messages::OperatorCommand start = command(Order::kStart, 1);
  start.mark = key_.mark_of(start, told.challenge);
  const Bytes recorded = bytes_of(start);
  EXPECT_TRUE(hear(vehicle_a, recorded).is_verified);
  for (const char* const name : {"b", "a"}) {
    LcmPort other = vehicle(proof_of(name));
    const Found found = hear(other, recorded);
    EXPECT_FALSE(found.is_verified) << name;
    EXPECT_FALSE(found.has_old_mark);
    EXPECT_EQ(found.troubles, (std::map<OrderTrouble, int>{{OrderTrouble::kNoMark, 1}}));
    start.mark = key_.mark_of(start, published_by(other).challenge);
    EXPECT_TRUE(hear(other, bytes_of(start)).is_verified) << "who reads the new challenge goes on commanding";
  }
}

TEST_F(LcmPortMarks, WithoutAChallengeAreToldApartAndCountOnlyWhereTheyAreToCount) {
  messages::OperatorCommand start = command(Order::kStart, 1);
  start.mark = key_.old_mark_of(start);
  LcmPort strict = vehicle(proof_of("a"));
  const Found found = hear(strict, bytes_of(start));
  EXPECT_FALSE(found.is_verified);
  EXPECT_TRUE(found.has_old_mark);
  EXPECT_EQ(found.troubles, (std::map<OrderTrouble, int>{{OrderTrouble::kOldMark, 1}}));
  LcmPort lenient = vehicle(proof_of("a", true));
  EXPECT_TRUE(hear(lenient, bytes_of(start)).is_verified);
}

TEST_F(LcmPortMarks, AreNotASendersOwnWord) {
  LcmPort port = vehicle(proof_of("a"));
  messages::OperatorCommand start = command(Order::kStart, 1);
  start.is_verified = true;
  EXPECT_FALSE(hear(port, bytes_of(start)).is_verified);
  LcmPort without_key(1, settings_);
  EXPECT_FALSE(hear(without_key, bytes_of(start)).is_verified);
}

TEST_F(LcmPortMarks, AreNoMatterToAnAbort) {
  LcmPort port = vehicle(proof_of("a"));
  EXPECT_TRUE(hear(port, bytes_of(command(Order::kAbort, 1))).troubles.empty());
}

}  // namespace
}  // namespace earshot::board
