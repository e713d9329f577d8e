#include "firmware/wire/n2k/own/orders.hpp"
#include "firmware/messages/dictionary/command_words.hpp"
#include "firmware/messages/dictionary/words.hpp"
#include "firmware/wire/n2k/table/messages.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace earshot::n2k {
namespace {

using messages::OperatorCommand;
using messages::Order;

constexpr std::uint8_t kUs = 0x40;
constexpr std::uint8_t kOperator = 0x23;
constexpr Route kRoute{.source = kOperator, .destination = kUs, .sequence = 7};
constexpr Time kNow{1'700'000'000'000'000};
constexpr OperatorCommand kStart{.time = Time{1'700'000'000'123'456},
                                 .expiry = Time{1'700'000'060'000'000},
                                 .issuer = 0xFFFF'FFFF,
                                 .number = 0xFFFF'FFFE,
                                 .order = Order::kStart};

class OrdersTest : public ::testing::Test {
 protected:
  Status accept(const Frame& frame) { return receiver_.accept(frame, kNow, kUs, command_, sender_); }
  static FastPacketFrames frames_of(const OperatorCommand& command, const Route& route = kRoute) {
    FastPacketFrames frames;
    EXPECT_EQ(compose_command(command, route, frames), Status::kOk);
    return frames;
  }

  OrderReceiver receiver_;
  OperatorCommand command_;
  std::uint8_t sender_ = 0;
};

TEST_F(OrdersTest, ComeBackWithAllTheirBits) {
  Status status = Status::kNotReady;
  for (const Frame& frame : frames_of(kStart)) {
    EXPECT_EQ(status, Status::kNotReady);
    EXPECT_EQ(frame.identifier, 0x0DEF4023U);  // 126720 = 0x1EF00 at priority 3, from 0x23 to 0x40
    status = accept(frame);
  }
  ASSERT_EQ(status, Status::kOk);
  EXPECT_EQ(command_, kStart);
  EXPECT_EQ(sender_, kOperator);
}

TEST_F(OrdersTest, TightenLimitsAndBearTheirMark) {
  OperatorCommand tighten = kStart;
  tighten.order = Order::kTighten;
  tighten.limits = {.max_depth = Meters{123.45}, .max_speed = {}, .max_time_s = 3600.0};
  tighten.mark = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 255};
  Status status = Status::kNotReady;
  std::vector<Frame> frames;
  for (const Frame& frame : frames_of(tighten)) {
    frames.push_back(frame);
    status = accept(frame);
  }
  ASSERT_EQ(status, Status::kOk);
  EXPECT_EQ(command_, tighten);
  // 53 bytes: 6 in the first frame, 7 in each of seven more. Bytes 28 to 30 are 12 345 cm = 0x003039; byte 31 and 32: no speed.
  ASSERT_EQ(frames.size(), 8U);
  EXPECT_EQ(frames[0].data[1], 53);
  EXPECT_EQ(frames[4].data[2], 0x39);
  EXPECT_EQ(frames[4].data[3], 0x30);
  EXPECT_EQ(frames[4].data[4], 0x00);
  EXPECT_EQ(frames[4].data[5], 0xFF);
  EXPECT_EQ(frames[4].data[6], 0xFF);
}

TEST_F(OrdersTest, ToAnotherDeviceAreNotOurs) {
  for (const Frame& frame : frames_of(kStart, {.source = kOperator, .destination = 0x41, .sequence = 0}))
    EXPECT_EQ(accept(frame), Status::kNotReady);
  Frame abort;
  ASSERT_EQ(compose_abort(1, 2, {.source = kOperator, .destination = 0x41}, abort), Status::kOk);
  EXPECT_EQ(accept(abort), Status::kNotReady);
}

TEST_F(OrdersTest, ToAbortComeInOneFrame) {
  Frame abort;
  ASSERT_EQ(compose_abort(0x1234, 0x56789A, kRoute, abort), Status::kOk);
  EXPECT_EQ(abort, (Frame{0x0DEF4023, 8, {0xFC, 0x9F, 3, 0x34, 0x12, 0x9A, 0x78, 0x56}}));
  ASSERT_EQ(accept(abort), Status::kOk);
  EXPECT_EQ(command_, (OperatorCommand{.time = kNow, .expiry = kNow, .issuer = 0x1234, .number = 0x56789A, .order = Order::kAbort}));
  EXPECT_EQ(compose_abort(0x10000, 1, kRoute, abort), Status::kOutOfRange);
}

TEST_F(OrdersTest, InOneFrameAreNotTakenOutOfTheMiddleOfAPacket) {
  // A packet of 223 bytes of sequence 7 whose frame 28 begins as an abort: 0xFC is 7 << 5 | 28.
  std::vector<std::uint8_t> bytes(223, 0);
  FastPacketFrames packet;
  ASSERT_EQ(compose_fast_packet({.pgn = kPeerPgn, .priority = 3, .source = kOperator, .destination = kUs}, 7, bytes, packet), Status::kOk);
  packet[28].data = {0xFC, 0x9F, 3, 1, 0, 1, 0, 0};
  for (const Frame& frame : packet) EXPECT_EQ(accept(frame), Status::kNotReady);
  EXPECT_EQ(receiver_.counters().taken, 0U);
  EXPECT_EQ(accept(packet[28]), Status::kOk) << "on its own";
}

TEST_F(OrdersTest, ToAllAreTakenOnlyWhenTheyAbort) {
  constexpr Route kToAll{.source = kOperator, .destination = kBroadcast, .sequence = 1};
  for (const Frame& frame : frames_of(kStart, kToAll))
    EXPECT_EQ(accept(frame), Status::kNotReady) << "it would start every vehicle of the bus";
  EXPECT_EQ(receiver_.counters().other, 1U);
  Frame abort;
  ASSERT_EQ(compose_abort(1, 2, kToAll, abort), Status::kOk);
  EXPECT_EQ(accept(abort), Status::kOk);
}

/// The first so many bytes of a message, cut anew.
FastPacketFrames cut_to(const FastPacketFrames& whole, std::size_t size, std::uint8_t destination) {
  FastPacketAssembly assembly;
  std::span<const std::uint8_t> bytes;
  for (const Frame& frame : whole)
    static_cast<void>(assembly.accept({.pgn = kPeerPgn, .source = kOperator, .destination = kUs}, frame, bytes));
  FastPacketFrames frames;
  const Identifier identifier{.pgn = kPeerPgn, .priority = 3, .source = kOperator, .destination = destination};
  EXPECT_EQ(compose_fast_packet(identifier, 5, bytes.first(size), frames), Status::kOk);
  return frames;
}

TEST_F(OrdersTest, ThatAbortAreTakenHoweverMuchOfThemIsCutOff) {
  OperatorCommand abort = kStart;
  abort.order = Order::kAbort;
  // Maker, kind and order are the first four bytes; a packet of 53 has all.
  for (std::size_t size = 4; size <= 53; ++size) {
    Status status = Status::kNotReady;
    for (const Frame& frame : cut_to(frames_of(abort), size, kUs)) status = accept(frame);
    ASSERT_EQ(status, Status::kOk) << size;
    EXPECT_EQ(command_.order, Order::kAbort) << size;
    EXPECT_EQ(command_.issuer, size < 8 ? 0U : kStart.issuer) << size;
    EXPECT_EQ(command_.number, size < 12 ? 0U : kStart.number) << size;
  }
  EXPECT_EQ(receiver_.counters().cut, 49U);
  EXPECT_EQ(receiver_.counters().taken, 50U);
  for (const Frame& frame : cut_to(frames_of(kStart), 52, kUs)) static_cast<void>(accept(frame));
  EXPECT_EQ(receiver_.counters().refused, 1U) << "nobody starts by half an order";
}

TEST_F(OrdersTest, ThatAbortInPacketsAreTakenWhenTheyGoToAll) {
  OperatorCommand abort = kStart;
  abort.order = Order::kAbort;
  Status status = Status::kNotReady;
  for (const Frame& frame : frames_of(abort, {.source = kOperator, .destination = kBroadcast, .sequence = 1})) status = accept(frame);
  EXPECT_EQ(status, Status::kOk);
  EXPECT_EQ(command_, abort);
}

TEST_F(OrdersTest, ThatNobodyKnowsComeAsTheyAreSoThatTheirSenderHearsSo) {
  OperatorCommand unknown = kStart;
  for (const int raw : {0, 4, 9}) {
    unknown.order = static_cast<Order>(raw);
    Status status = Status::kNotReady;
    for (const Frame& frame : frames_of(unknown)) status = accept(frame);
    EXPECT_EQ(status, Status::kOk);
    EXPECT_EQ(command_, unknown);
  }
}

TEST_F(OrdersTest, OfOtherMakersAreRefused) {
  Status status = Status::kNotReady;
  FastPacketFrames frames = frames_of(kStart);
  frames[0].data[2] = 0x3F;  // another maker
  for (const Frame& frame : frames) status = accept(frame);
  EXPECT_EQ(status, Status::kNotReady);
  frames = frames_of(kStart);
  frames[0].data[2] = 0xFC;
  frames[0].data[3] = 0x1F;  // our maker's code, another group of industry: 0x9F has the marine one, 4
  for (const Frame& frame : frames) status = accept(frame);
  EXPECT_EQ(status, Status::kNotReady);
  EXPECT_EQ(receiver_.counters().other, 2U);
}

TEST_F(OrdersTest, AndTheirAnswersLieByteForByteWhereOtherProgramsExpectThem) {
  using Bytes = std::vector<std::uint8_t>;
  const auto bytes_of = [](const FastPacketFrames& frames) {
    FastPacketAssembly assembly;
    std::span<const std::uint8_t> bytes;
    for (const Frame& frame : frames) static_cast<void>(assembly.accept({.pgn = kPeerPgn, .source = 1}, frame, bytes));
    return Bytes(bytes.begin(), bytes.end());
  };
  const OperatorCommand command{.time = Time{0x0807060504030201},
                                .expiry = Time{0x1817161514131211},
                                .issuer = 0x24232221,
                                .number = 0x34333231,
                                .order = Order::kComplete};  // 2
  Bytes expected{0xFC, 0x9F, 1, 2, 0x21, 0x22, 0x23, 0x24, 0x31, 0x32, 0x33, 0x34, 1,    2,
                 3,    4,    5, 6, 7,    8,    0x11, 0x12, 0x13, 0x14, 0x15, 0x16, 0x17, 0x18};
  expected.insert(expected.end(), 9, 0xFF);   // no limits
  expected.insert(expected.end(), 16, 0x00);  // no mark
  EXPECT_EQ(bytes_of(frames_of(command)), expected);
  FastPacketFrames frames;
  ASSERT_EQ(compose_acknowledgement({.time = Time{0x0807060504030201},
                                     .port = 0,
                                     .issuer = 0x24232221,
                                     .number = 0x34333231,
                                     .order = Order::kAbort,                                // 3
                                     .outcome = messages::CommandOutcome::kNotConfigured},  // 6
                                    kRoute, frames),
            Status::kOk);
  EXPECT_EQ(bytes_of(frames), (Bytes{0xFC, 0x9F, 2, 3, 0x21, 0x22, 0x23, 0x24, 0x31, 0x32, 0x33, 0x34, 6, 1, 2, 3, 4, 5, 6, 7, 8}));
}

TEST_F(OrdersTest, AreTakenWhateverTheirReservedBitsSay) {
  FastPacketFrames frames = frames_of(kStart);
  frames[0].data[3] = 0x87;  // 0x9F without bits 11 and 12
  Status status = Status::kNotReady;
  for (const Frame& frame : frames) status = accept(frame);
  EXPECT_EQ(status, Status::kOk);
  EXPECT_EQ(command_, kStart);
}

TEST_F(OrdersTest, AreCountedByWhatBecameOfThem) {
  for (const Frame& frame : frames_of(kStart)) static_cast<void>(accept(frame));
  EXPECT_EQ(receiver_.counters().taken, 1U);
  FastPacketFrames undated = frames_of(kStart);
  // 8 bytes from the twelfth on say "not available": 0x7FFF'FFFF'FFFF'FFFF. The twelfth is byte 6 of frame 1's seven.
  undated[1].data[7] = 0xFF;
  undated[2].data = {undated[2].data[0], 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0x7F};
  Status status = Status::kOk;
  for (const Frame& frame : undated) status = accept(frame);
  EXPECT_EQ(status, Status::kMalformed);
  EXPECT_EQ(sender_, kOperator) << "who is to hear so";
  EXPECT_EQ(command_.issuer, kStart.issuer);
  EXPECT_EQ(command_.number, kStart.number);
  EXPECT_EQ(command_.order, Order::kStart);
  EXPECT_EQ(receiver_.counters().taken, 1U);
  EXPECT_EQ(receiver_.counters().refused, 1U);
  EXPECT_EQ(receiver_.counters().other, 0U);
}

TEST_F(OrdersTest, AreNotFoundInOurOwnAnswersComeBackOrThoseOfOthers) {
  const messages::CommandAcknowledgement answer{
      .time = kNow, .port = 0, .issuer = 1, .number = 2, .order = Order::kStart, .outcome = messages::CommandOutcome::kObeyed};
  FastPacketFrames frames;
  ASSERT_EQ(compose_acknowledgement(answer, {.source = kUs, .destination = kOperator, .sequence = 0}, frames), Status::kOk);
  for (const Frame& frame : frames) EXPECT_EQ(accept(frame), Status::kNotReady);
  EXPECT_EQ(receiver_.counters().other, 0U) << "it is not to us";
  ASSERT_EQ(compose_acknowledgement(answer, {.source = kOperator, .destination = kUs, .sequence = 0}, frames), Status::kOk);
  for (const Frame& frame : frames) EXPECT_EQ(accept(frame), Status::kNotReady);
  EXPECT_EQ(receiver_.counters().other, 1U) << "an answer is no order";
  EXPECT_EQ(receiver_.counters().taken, 0U);
}

TEST_F(OrdersTest, WhoseAnswerNobodyKnowsIsRefused) {
  FastPacketFrames frames;
  const messages::CommandAcknowledgement sent{
      .time = kNow, .port = 0, .issuer = 1, .number = 2, .order = Order::kStart, .outcome = messages::kHighest<messages::CommandOutcome>};
  ASSERT_EQ(compose_acknowledgement(sent, kRoute, frames), Status::kOk);
  FastPacketAssembly assembly;
  std::span<const std::uint8_t> view;
  for (const Frame& frame : frames)
    static_cast<void>(assembly.accept({.pgn = kPeerPgn, .source = kOperator, .destination = kUs}, frame, view));
  std::vector<std::uint8_t> bytes(view.begin(), view.end());
  ASSERT_EQ(bytes[12], 13);
  EXPECT_TRUE(read_acknowledgement(bytes).ok());
  bytes[12] = 14;
  EXPECT_EQ(read_acknowledgement(bytes).status(), Status::kUnsupported);
  bytes[12] = 0xFF;
  EXPECT_EQ(read_acknowledgement(bytes).status(), Status::kNotReady);
}

TEST_F(OrdersTest, AreAcknowledgedWithAllTheirBits) {
  const messages::CommandAcknowledgement sent{.time = kNow,
                                              .port = 0,
                                              .issuer = 0xFFFF'FFFF,
                                              .number = 3,
                                              .order = Order::kComplete,
                                              .outcome = messages::CommandOutcome::kOutOfOrder};
  FastPacketFrames frames;
  ASSERT_EQ(compose_acknowledgement(sent, {.source = kUs, .destination = kOperator, .sequence = 0}, frames), Status::kOk);
  FastPacketAssembly assembly;
  std::span<const std::uint8_t> bytes;
  for (const Frame& frame : frames) {
    EXPECT_EQ(frame.identifier, 0x0DEF2340U);
    static_cast<void>(assembly.accept({.pgn = kPeerPgn, .source = kUs, .destination = kOperator}, frame, bytes));
  }
  ASSERT_EQ(bytes.size(), 21U);
  EXPECT_EQ(read_acknowledgement(bytes).value(), sent);
  EXPECT_EQ(read_command(bytes).status(), Status::kUnsupported);
}

}  // namespace
}  // namespace earshot::n2k
