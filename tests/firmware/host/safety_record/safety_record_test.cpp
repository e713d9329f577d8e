#include "firmware/host/safety_record/safety_record.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "firmware/core/big_endian.hpp"
#include "firmware/core/crc32.hpp"
#include "tests/firmware/host/safety_record/some_record.hpp"

namespace earshot::host {
namespace {

TEST(SafetyRecord, ReadsBackEveryField) {
  SafetyRecord record = some_record(7);
  EXPECT_EQ(read_safety_record(encoded(record)), record);
  record.is_paused = record.is_closed = true;
  record.is_engaged = record.is_released = false;
  EXPECT_EQ(read_safety_record(encoded(record)), record);
}

TEST(SafetyRecord, IsNoneOnceAnyBitOfItHasFlippedOrItsEndIsMissing) {
  const SafetyRecordBytes whole = encoded(some_record(7));
  for (std::size_t bit = 0; bit < 8 * whole.size(); ++bit) {
    SafetyRecordBytes flipped = whole;
    flipped[bit / 8] = static_cast<std::uint8_t>(flipped[bit / 8] ^ (1U << (bit % 8)));
    EXPECT_FALSE(read_safety_record(flipped)) << bit;
  }
  for (std::size_t size = 0; size < whole.size(); ++size) EXPECT_FALSE(read_safety_record(std::span(whole).first(size)));
}

TEST(SafetyRecord, BeginsAsItsFormatSaysAndFillsItsBytes) {
  const SafetyRecordBytes bytes = encoded(some_record(0x0102030405060708));
  // "EARSHOTR", format 2, the sequence; before the owner and the checksum the turning radius, 29.0 as IEEE 754 has it.
  const SafetyRecordBytes expected{'E', 'A', 'R', 'S', 'H', 'O', 'T', 'R', 0, 0, 0, 2, 1, 2, 3, 4, 5, 6, 7, 8};
  for (std::size_t i = 0; i < 20; ++i) EXPECT_EQ(bytes[i], expected[i]) << i;
  EXPECT_EQ(bytes[bytes.size() - 20], 0x40);
  EXPECT_EQ(bytes[bytes.size() - 19], 0x3D);
  EXPECT_EQ(bytes[bytes.size() - 9], 30) << "the computer";
  EXPECT_EQ(bytes[bytes.size() - 5], 31) << "the folder";
}

TEST(SafetyRecord, OfTheFormatWithoutAnOwnerIsReadAsAnybodys) {
  const SafetyRecordBytes now = encoded(some_record(7));
  std::vector<std::uint8_t> before(now.begin(), now.begin() + 134);
  before[11] = 1;
  before.resize(138);
  store_big_endian(std::span(before).subspan(134), crc32(std::span(before).first(134)));
  SafetyRecord expected = some_record(7);
  expected.owner = {};
  EXPECT_EQ(read_safety_record(before), expected);
  EXPECT_TRUE(may_be_same(expected.owner, some_record(7).owner));
  before[134] ^= 1U;
  EXPECT_FALSE(read_safety_record(before));
}

TEST(SafetyRecord, IsOfAnotherWhereComputerOrFolderAreKnownToDiffer) {
  const RecordOwner ours{.computer = 1, .folder = 2};
  EXPECT_TRUE(may_be_same(ours, ours));
  EXPECT_TRUE(may_be_same(ours, {.computer = 0, .folder = 2}));
  EXPECT_FALSE(may_be_same(ours, {.computer = 3, .folder = 2}));
  EXPECT_FALSE(may_be_same(ours, {.computer = 1, .folder = 3}));
}

/// Of a flight, in the first second of a start of the computer.
SafetyRecord of_flight(std::uint32_t journal, std::uint64_t sequence, std::int64_t second, bool is_under_way) {
  SafetyRecord record = some_record(sequence);
  record.journal_crc32 = journal;
  record.since_boot = Duration::seconds(second);
  record.utc = record.utc + Duration::seconds(second);
  record.is_closed = !is_under_way;
  return record;
}

TEST(NewestRecord, IsTheOneWithTheHighestSequenceOfAFlight) {
  const std::vector<SafetyRecord> records{of_flight(1, 5, 50, true), of_flight(1, 7, 40, false), of_flight(1, 6, 60, true)};
  EXPECT_EQ(newest_of(records), records[1]);
  EXPECT_FALSE(newest_of({}));
}

TEST(NewestRecord, OfTwoFlightsIsTheLatersThoughTheFirstHasHigherNumbers) {
  const std::vector<SafetyRecord> records{of_flight(1, 30, 50, false), of_flight(2, 4, 900, true)};
  EXPECT_EQ(newest_of(records), records[1]);
  const std::vector<SafetyRecord> closed{of_flight(2, 4, 900, false), of_flight(1, 30, 50, true)};
  EXPECT_EQ(newest_of(closed), closed[0]) << "one clock says that it is the later";
}

TEST(NewestRecord, IsOfTheFlightThatIsUnderWayWhereNoClockSaysForCertainWhichIsTheLater) {
  std::vector<SafetyRecord> records{of_flight(1, 30, 900, false), of_flight(2, 4, 50, true)};
  records[0].boot[0] ^= 1U;
  EXPECT_EQ(newest_of(records), records[1]);
  records[0].boot = records[1].boot = {};
  EXPECT_EQ(newest_of(records), records[1]);
}

TEST(SafetyRecord, IsUnderWayWhileItSearchesOrSetPointsLeaveAndNobodyHasStoppedTheProgram) {
  SafetyRecord record;
  EXPECT_FALSE(is_under_way(record));
  record.state = messages::MissionState::kSearch;
  EXPECT_TRUE(is_under_way(record)) << "it listens";
  record.state = messages::MissionState::kAbort;
  EXPECT_FALSE(is_under_way(record)) << "it never commanded";
  record.is_engaged = true;
  for (const messages::MissionState state :
       {messages::MissionState::kSearch, messages::MissionState::kDone, messages::MissionState::kAbort}) {
    record.state = state;
    EXPECT_TRUE(is_under_way(record));
  }
  record.is_closed = true;
  EXPECT_FALSE(is_under_way(record));
}

}  // namespace
}  // namespace earshot::host
