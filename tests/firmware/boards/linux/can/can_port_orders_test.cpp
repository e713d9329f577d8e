// can_port.cpp: what it makes of orders, readable or not.

#include <array>
#include <vector>

#include "firmware/boards/linux/can/can_port.hpp"
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

}  // namespace
}  // namespace earshot::board
