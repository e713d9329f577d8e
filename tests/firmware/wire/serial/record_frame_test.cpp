#include "firmware/wire/serial/record_frame.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

namespace earshot::wire {
namespace {

using Bytes = std::vector<std::uint8_t>;

Bytes unstuffed(std::span<const std::uint8_t> line) {
  Bytes memory(kFrameBytes);
  CobsReader reader(memory);
  for (const std::uint8_t byte : line) {
    if (reader.take(byte) == CobsReader::Outcome::kFrame) return {reader.frame().begin(), reader.frame().end()};
  }
  return {};
}

const Bytes kData{0x00, 0x01, 0xFF};

// The CRC-32 by zlib: python3 -c 'import zlib; print(hex(zlib.crc32(bytes.fromhex("00000000000001020241420001ff"))))'
TEST(RecordFrame, IsDateNameDataAndTheirCrc32) {
  const RecordFrame frame(Time{258}, "AB", kData);
  EXPECT_EQ(unstuffed(frame.bytes()), (Bytes{0, 0, 0, 0, 0, 0, 1, 2, 2, 'A', 'B', 0x00, 0x01, 0xFF, 0xA7, 0xD1, 0xF6, 0xF8}));
}

TEST(RecordFrame, ComesBack) {
  const RecordFrame frame(Time{1'700'000'000'000'000}, "EARSHOT_NAV_STATE.1", kData);
  const Bytes bytes = unstuffed(frame.bytes());
  FramedRecord record;
  ASSERT_EQ(read_record_frame(bytes, record), Status::kOk);
  EXPECT_EQ(record.time, Time{1'700'000'000'000'000});
  EXPECT_EQ(record.channel, "EARSHOT_NAV_STATE.1");
  EXPECT_EQ(Bytes(record.data.begin(), record.data.end()), kData);
}

TEST(RecordFrame, IsRefusedWithAnyBitOfItFlipped) {
  const Bytes good = unstuffed(RecordFrame(Time{7}, "AB", kData).bytes());
  FramedRecord record;
  ASSERT_EQ(read_record_frame(good, record), Status::kOk);
  for (std::size_t bit = 0; bit < 8 * good.size(); ++bit) {
    Bytes bad = good;
    bad[bit / 8] = static_cast<std::uint8_t>(bad[bit / 8] ^ (1U << (bit % 8)));
    EXPECT_EQ(read_record_frame(bad, record), Status::kMalformed) << "bit " << bit;
  }
}

TEST(RecordFrame, IsRefusedWhenItIsTooShortToHoldItsChannel) {
  const Bytes whole = unstuffed(RecordFrame(Time{7}, "AB", kData).bytes());
  FramedRecord record;
  for (std::size_t size = 0; size < whole.size(); ++size)
    EXPECT_EQ(read_record_frame(std::span(whole).first(size), record), Status::kMalformed) << size << " bytes";
}

}  // namespace
}  // namespace earshot::wire
