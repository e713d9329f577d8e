#include "firmware/host/journal/journal_reader.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "firmware/config/capacities.hpp"
#include "firmware/host/journal/journal_format.hpp"
#include "tests/firmware/host/journal/journal_folder.hpp"

namespace earshot::host {
namespace {

class JournalReaderTest : public JournalFolder {};

TEST_F(JournalReaderTest, CutAtAnyByteReadsBackToTheLastCompleteRecord) {
  write_three_records();
  const Bytes whole = contents();
  const std::size_t first = 28 + 1 + 3;
  const std::size_t second = first + 28 + 2;
  for (std::size_t size = 0; size < whole.size(); ++size) {
    overwrite(Bytes(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size)));
    const bool at_end_of_record = size == 0 || size == first || size == second;
    const std::size_t complete = size < first ? 0 : size < second ? 1 : 2;
    EXPECT_EQ(records_until(at_end_of_record ? JournalReader::End::kWhole : JournalReader::End::kCut), complete) << size;
  }
}

TEST_F(JournalReaderTest, SaysAtACutEndTheSameToWhoAsksAgain) {
  write_three_records();
  const Bytes whole = contents();
  overwrite(Bytes(whole.begin(), whole.end() - 1));
  JournalReader reader(path_);
  for (JournalRecord record; reader.next(record);) {
  }
  JournalRecord none;
  EXPECT_FALSE(reader.next(none));
  EXPECT_EQ(reader.end(), JournalReader::End::kCut);
  EXPECT_EQ(reader.damages().size(), 1U);
  reader.resume_reading();
  EXPECT_FALSE(reader.next(none));
  EXPECT_EQ(reader.damages().size(), 1U);
}

/// The damage of a journal all of which can be read but a stretch.
using Damages = std::vector<JournalDamage>;

TEST_F(JournalReaderTest, LosesToAFlippedBitTheRecordThatItHitsAndNoOther) {
  write_three_records();
  const Bytes whole = contents();
  const std::vector<std::size_t> begins{0, 28 + 1 + 3, 28 + 1 + 3 + 28 + 2, whole.size()};
  for (std::size_t bit = 0; bit < 8 * whole.size(); ++bit) {
    Bytes flipped = whole;
    flipped[bit / 8] = static_cast<std::uint8_t>(flipped[bit / 8] ^ (1U << (bit % 8)));
    overwrite(flipped);
    const std::size_t hit = bit / 8 < begins[1] ? 0 : bit / 8 < begins[2] ? 1 : 2;
    JournalReader reader(path_);
    std::vector<std::uint32_t> numbers;
    for (JournalRecord record; reader.next(record);) numbers.push_back(record.number);
    std::vector<std::uint32_t> others{0, 1, 2};
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(hit));
    ASSERT_EQ(numbers, others) << bit;
    ASSERT_EQ(reader.damages(), (Damages{{begins[hit], begins[hit + 1] - begins[hit]}})) << bit;
    ASSERT_EQ(reader.end() != JournalReader::End::kWhole, hit == 2) << bit;
  }
}

TEST_F(JournalReaderTest, ReadsOnBehindALengthThatReachesBeyondTheFile) {
  write_three_records();
  Bytes bytes = contents();
  store_big_endian(std::span(bytes).subspan(24, 4), config::kLcmMessageBytes);
  overwrite(bytes);
  JournalReader reader(path_);
  JournalRecord record;
  ASSERT_TRUE(reader.next(record));
  EXPECT_EQ(record.number, 1U);
  EXPECT_EQ(reader.damages(), (Damages{{0, 32}}));
}

TEST_F(JournalReaderTest, FindsEveryRecordBetweenStretchesOfNoise) {
  // Noise that begins like a record again and again, of every length around the 1 MiB that a reader looks at.
  write_three_records();
  const Bytes whole = contents();
  Bytes bytes;
  Damages damages;
  for (const std::size_t length : {1U, 4U, 27U, 28U, 100U, 1'048'575U, 1'048'576U, 3'000'001U}) {
    damages.push_back({bytes.size(), length});
    for (std::size_t i = 0; i < length; ++i) bytes.push_back(std::array<std::uint8_t, 5>{0xED, 0xA1, 0xDA, 0x01, 0x00}[i * i % 5]);
    bytes.insert(bytes.end(), whole.begin(), whole.end());
  }
  overwrite(bytes);
  JournalReader reader(path_);
  std::size_t count = 0;
  for (JournalRecord record; reader.next(record); ++count) ASSERT_EQ(record.number, count % 3);
  EXPECT_EQ(count, 3U * 8U);
  EXPECT_EQ(reader.damages(), damages);
  EXPECT_EQ(reader.end(), JournalReader::End::kWhole);
}

TEST_F(JournalReaderTest, ChecksNoByteMoreThanThriceThoughTheLargestRecordSeemsToBeginAgainAndAgain) {
  write_three_records();
  const Bytes whole = contents();
  Bytes beginning(kRecordHeaderSize);
  store_big_endian(std::span(beginning).first(4), kRecordSync);
  store_big_endian(std::span(beginning).subspan(20, 4), 1);
  store_big_endian(std::span(beginning).subspan(24, 4), config::kLcmMessageBytes);
  Bytes bytes;
  for (int i = 0; i < 30; ++i) {
    for (int j = 0; j < 4000; ++j) bytes.insert(bytes.end(), beginning.begin(), beginning.end());
    bytes.insert(bytes.end(), whole.begin(), whole.end());
  }
  // At the end, where every second reaches beyond the file.
  Bytes smaller = beginning;
  store_big_endian(std::span(smaller).subspan(24, 4), config::kLcmMessageBytes / 2);
  for (int j = 0; j < 2000; ++j) {
    bytes.insert(bytes.end(), smaller.begin(), smaller.end());
    bytes.insert(bytes.end(), beginning.begin(), beginning.end());
  }
  overwrite(bytes);
  JournalReader reader(path_);
  std::size_t count = 0;
  for (JournalRecord record; reader.next(record); ++count) ASSERT_EQ(record.number, count % 3);
  EXPECT_EQ(count, 3U * 30U);
  EXPECT_EQ(reader.end(), JournalReader::End::kCorrupt);
  EXPECT_LE(reader.checked_bytes(), 3 * bytes.size()) << "each beginning by itself: 131 KiB for 28 bytes, 4700 times as much";
}

TEST_F(JournalReaderTest, TakesAnEmptyEndForAPowerCut) {
  write_three_records();
  const auto size = std::filesystem::file_size(path_);
  std::filesystem::resize_file(path_, size + 4096);  // as a file system leaves it that knew the length and not yet the bytes
  JournalReader reader(path_);
  std::size_t count = 0;
  for (JournalRecord record; reader.next(record);) ++count;
  EXPECT_EQ(count, 3U);
  EXPECT_EQ(reader.end(), JournalReader::End::kCut);
  EXPECT_EQ(reader.offset(), size);
  EXPECT_EQ(reader.damages(), (Damages{{size, 4096}}));
}

TEST_F(JournalReaderTest, FollowsAJournalThatGrowsByteByByte) {
  write_three_records();
  const Bytes whole = contents();
  overwrite({});
  JournalReader reader(path_);
  std::size_t count = 0;
  for (std::size_t size = 0; size <= whole.size(); ++size) {
    overwrite(Bytes(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size)));
    for (JournalRecord record; reader.next(record); ++count) ASSERT_EQ(record.number, count);
    reader.resume_reading();
  }
  EXPECT_EQ(count, 3U);
  EXPECT_TRUE(reader.damages().empty());
}

}  // namespace
}  // namespace earshot::host
