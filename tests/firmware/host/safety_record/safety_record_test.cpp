#include "firmware/host/safety_record/safety_record.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <span>

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
  // "EARSHOTR", format 1, the sequence; before the checksum the turning radius, 29.0 as IEEE 754 has it.
  const SafetyRecordBytes expected{'E', 'A', 'R', 'S', 'H', 'O', 'T', 'R', 0, 0, 0, 1, 1, 2, 3, 4, 5, 6, 7, 8};
  for (std::size_t i = 0; i < 20; ++i) EXPECT_EQ(bytes[i], expected[i]) << i;
  EXPECT_EQ(bytes[bytes.size() - 12], 0x40);
  EXPECT_EQ(bytes[bytes.size() - 11], 0x3D);
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
