#include "firmware/wire/journal/closing_record.hpp"

#include <gtest/gtest.h>

#include <array>

#include "earshot/journal_end_t.hpp"
#include "firmware/wire/lcm/encoding.hpp"
#include "tests/support/lcm_peer.hpp"

namespace earshot::wire {
namespace {

constexpr messages::ClosingRecord kAborted{.time = Time{1'795'000'000'000'000},
                                           .ending = messages::Ending::kClockLost,
                                           .state = messages::MissionState::kAbort,
                                           .end_reason = messages::EndReason::kSnrStale,
                                           .steps_taken = 37,
                                           .lost = {.streams = 5'000'000'000, .steering = 2, .orders = 1}};

TEST(ClosingRecord, IsWhatStockToolsReadAsItsType) {
  const Encoded bytes(kAborted);
  // Fingerprint 8, date 8, three of 1, steps 4, three counts of 8.
  EXPECT_EQ(bytes.bytes().size(), 47U);
  journal_end_t m{};
  ASSERT_EQ(support::read_peer(bytes.bytes(), m), Status::kOk);
  EXPECT_EQ(m.utime, 1'795'000'000'000'000);
  EXPECT_EQ(m.ending, +journal_end_t::CLOCK_LOST);
  EXPECT_EQ(m.state, 3);
  EXPECT_EQ(m.end_reason, 5);
  EXPECT_EQ(m.steps_taken, 37);
  EXPECT_EQ(m.streams_lost, 5'000'000'000);
  EXPECT_EQ(m.steering_lost, 2);
  EXPECT_EQ(m.orders_lost, 1);
}

TEST(ClosingRecord, IsReadBackAsItWas) {
  messages::ClosingRecord read;
  ASSERT_EQ(read_closing_record(Encoded(kAborted).bytes(), read), Status::kOk);
  EXPECT_EQ(read, kAborted);
  EXPECT_EQ(read.lost.all(), 5'000'000'003U);
}

TEST(ClosingRecord, IsRefusedWhenItNamesWhatThereIsNotOrIsCut) {
  messages::ClosingRecord read;
  const auto with = [](auto change) {
    journal_end_t m{};
    change(m);
    return support::bytes_of(m);
  };
  EXPECT_EQ(read_closing_record(with([](journal_end_t&) {}), read), Status::kOk);
  EXPECT_EQ(read_closing_record(with([](journal_end_t& m) { m.ending = 3; }), read), Status::kOutOfRange);
  EXPECT_EQ(read_closing_record(with([](journal_end_t& m) { m.state = 4; }), read), Status::kOutOfRange);
  EXPECT_EQ(read_closing_record(with([](journal_end_t& m) { m.end_reason = -1; }), read), Status::kOutOfRange);
  EXPECT_EQ(read_closing_record(with([](journal_end_t& m) { m.end_reason = 12; }), read), Status::kOutOfRange);
  EXPECT_EQ(read_closing_record(with([](journal_end_t& m) { m.steps_taken = -1; }), read), Status::kOutOfRange);
  EXPECT_EQ(read_closing_record(with([](journal_end_t& m) { m.orders_lost = -1; }), read), Status::kOutOfRange);
  EXPECT_EQ(read_closing_record(Encoded(kAborted).bytes().first(46), read), Status::kMalformed);
}

}  // namespace
}  // namespace earshot::wire
