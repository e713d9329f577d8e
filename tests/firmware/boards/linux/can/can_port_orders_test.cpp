// can_port.cpp: what it makes of orders, readable or not.

#include <array>
#include <vector>

#include "firmware/boards/linux/can/can_port.hpp"
#include "firmware/wire/n2k/own/challenge.hpp"
#include "firmware/wire/n2k/table/messages.hpp"
#include "tests/firmware/boards/linux/can/bus_rig.hpp"

namespace earshot::board {
namespace {

using messages::Order;

class CanPortOrders : public BusRig {
 protected:
  /// The first so many bytes of an order, as one packet.
  void send_cut(Order order, std::size_t size) {
    const messages::OperatorCommand command{
        .time = clock_.time, .expiry = clock_.time + Duration::seconds(10), .issuer = 4711, .number = 3, .order = order};
    n2k::FastPacketFrames frames;
    ASSERT_EQ(n2k::compose_command(command, {.source = kCommander, .destination = kOwn, .sequence = 0}, frames), Status::kOk);
    n2k::FastPacketAssembly assembly;
    std::span<const std::uint8_t> bytes;
    const n2k::Identifier identifier{.pgn = n2k::kPeerPgn, .priority = 3, .source = kCommander, .destination = kOwn};
    for (const n2k::Frame& frame : frames) (void)assembly.accept(identifier, frame, bytes);
    const std::vector<std::uint8_t> cut(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size));
    ASSERT_EQ(n2k::compose_fast_packet(identifier, sequence_++, cut, frames), Status::kOk);
    send_all(frames);
  }
};

TEST_F(CanPortOrders, ObeyAnAbortOfWhichHalfIsMissing) {
  open_settled();
  send_cut(Order::kAbort, 20);
  collect();
  const std::vector<messages::OperatorCommand> orders = taken_.all<messages::OperatorCommand>();
  ASSERT_EQ(orders.size(), 1U);
  EXPECT_EQ(orders[0].order, Order::kAbort);
  EXPECT_EQ(orders[0].issuer, 4711U);
  EXPECT_EQ(taken_.order_troubles, (std::vector{OrderTrouble::kCutAbort}));
}

TEST_F(CanPortOrders, AnswerTheSenderOfOneThatCannotBeRead) {
  open_settled();
  send_cut(Order::kStart, 20);
  collect();
  EXPECT_TRUE(taken_.all<messages::OperatorCommand>().empty());
  EXPECT_EQ(taken_.order_troubles, (std::vector{OrderTrouble::kUnreadable}));
  const std::vector<Heard> answers = heard(n2k::kPeerPgn);
  ASSERT_EQ(answers.size(), 1U);
  EXPECT_EQ(answers[0].identifier.destination, kCommander);
  const Result<messages::CommandAcknowledgement> answer = n2k::read_acknowledgement(answers[0].bytes);
  ASSERT_TRUE(answer.ok());
  EXPECT_EQ(answer.value().outcome, messages::CommandOutcome::kUnreadable);
  EXPECT_EQ(answer.value().issuer, 4711U);
  EXPECT_EQ(answer.value().number, 3U);
  EXPECT_EQ(port_->report().malformed, 1U);
}

TEST_F(CanPortOrders, AreMarkedForTheChallengeThatTheVehicleTellsOnceASecond) {
  const host::CommandKey key(host::KeyBytes{7});
  settings_.command_proof = {.key = key, .challenge = host::new_challenge("auv-7", {}), .accepts_old_marks = false};
  open_settled();
  port_->publish(clock_.time, {});
  port_->publish(clock_.time + Duration::milliseconds(200), {});
  const std::vector<Heard> told = heard(n2k::kChallengePgn);
  ASSERT_EQ(told.size(), 1U);
  const Result<messages::PublishedChallenge> challenge = n2k::read_challenge(told[0].bytes);
  ASSERT_TRUE(challenge.ok());
  EXPECT_TRUE(key.verifies(challenge.value()));
  messages::OperatorCommand start{
      .time = clock_.time, .expiry = clock_.time + Duration::seconds(10), .issuer = 4711, .number = 3, .order = Order::kStart};
  const auto send_composed = [&] {
    n2k::FastPacketFrames frames;
    ASSERT_EQ(n2k::compose_command(start, {.source = kCommander, .destination = kOwn, .sequence = sequence_++}, frames), Status::kOk);
    send_all(frames);
    collect();
  };
  send_composed();
  start.mark = key.mark_of(start, challenge.value().challenge);
  send_composed();
  start.mark = key.old_mark_of(start);
  send_composed();
  const std::vector<messages::OperatorCommand> orders = taken_.all<messages::OperatorCommand>();
  ASSERT_EQ(orders.size(), 3U);
  EXPECT_FALSE(orders[0].is_verified);
  EXPECT_TRUE(orders[1].is_verified);
  EXPECT_TRUE(orders[2].has_old_mark);
  EXPECT_EQ(taken_.order_troubles, (std::vector{OrderTrouble::kNoMark, OrderTrouble::kOldMark}));
}

TEST_F(CanPortOrders, NeedNoChallengeWhereThereIsNoKey) {
  open_settled();
  port_->publish(clock_.time, {});
  EXPECT_TRUE(heard(n2k::kChallengePgn).empty());
}

}  // namespace
}  // namespace earshot::board
