#include "firmware/wire/journal/closing_record.hpp"

#include <gtest/gtest.h>

#include <array>

#include "earshot/journal_end_t.hpp"

namespace earshot::wire {
namespace {

constexpr ClosingRecord kAborted{.time = Time{1'795'000'000'000'000},
                                 .ending = Ending::kClockLost,
                                 .state = messages::MissionState::kAbort,
                                 .end_reason = messages::EndReason::kSnrStale,
                                 .steps_taken = 37,
                                 .lost = {.streams = 5'000'000'000, .steering = 2, .orders = 1}};

TEST(ClosingRecord, IsWhatStockToolsReadAsItsType) {
  const Encoded bytes = encoded(kAborted);
  EXPECT_EQ(bytes.bytes().size(), kClosingRecordBytes);
  journal_end_t m{};
  ASSERT_EQ(decode(bytes.bytes(), m), Status::kOk);
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
  ClosingRecord read;
  ASSERT_EQ(read_closing_record(encoded(kAborted).bytes(), read), Status::kOk);
  EXPECT_EQ(read, kAborted);
  EXPECT_EQ(read.lost.all(), 5'000'000'003U);
}

TEST(ClosingRecord, IsRefusedWhenItNamesWhatThereIsNotOrIsCut) {
  ClosingRecord read;
  const auto with = [](auto change) {
    journal_end_t m{};
    change(m);
    return Encoded(m);
  };
  EXPECT_EQ(read_closing_record(with([](journal_end_t&) {}).bytes(), read), Status::kOk);
  EXPECT_EQ(read_closing_record(with([](journal_end_t& m) { m.ending = 3; }).bytes(), read), Status::kOutOfRange);
  EXPECT_EQ(read_closing_record(with([](journal_end_t& m) { m.state = 4; }).bytes(), read), Status::kOutOfRange);
  EXPECT_EQ(read_closing_record(with([](journal_end_t& m) { m.end_reason = -1; }).bytes(), read), Status::kOutOfRange);
  EXPECT_EQ(read_closing_record(with([](journal_end_t& m) { m.end_reason = 12; }).bytes(), read), Status::kOutOfRange);
  EXPECT_EQ(read_closing_record(with([](journal_end_t& m) { m.steps_taken = -1; }).bytes(), read), Status::kOutOfRange);
  EXPECT_EQ(read_closing_record(with([](journal_end_t& m) { m.orders_lost = -1; }).bytes(), read), Status::kOutOfRange);
  EXPECT_EQ(read_closing_record(encoded(kAborted).bytes().first(kClosingRecordBytes - 1), read), Status::kMalformed);
}

}  // namespace
}  // namespace earshot::wire
