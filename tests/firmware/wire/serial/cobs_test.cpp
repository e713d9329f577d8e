#include "firmware/wire/serial/cobs.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "firmware/core/random.hpp"

namespace earshot::wire {
namespace {

using Bytes = std::vector<std::uint8_t>;

Bytes stuffed(const Bytes& from) {
  Bytes to(cobs_room(from.size()));
  to.resize(stuff(from, to));
  return to;
}

Bytes run(std::size_t size, std::uint8_t first) {
  Bytes bytes;
  for (std::size_t i = 0; i < size; ++i) bytes.push_back(static_cast<std::uint8_t>(first + i));
  return bytes;
}

Bytes with(std::uint8_t first, Bytes rest, const Bytes& last = {}) {
  rest.insert(rest.begin(), first);
  rest.insert(rest.end(), last.begin(), last.end());
  return rest;
}

// The examples of Cheshire and Baker's method, with the ending zero (Wikipedia, "Consistent Overhead Byte Stuffing", which lists them by
// number).
TEST(Cobs, StuffsTheExamplesThatArePrintedForIt) {
  EXPECT_EQ(stuffed({0x00}), (Bytes{0x01, 0x01, 0x00}));
  EXPECT_EQ(stuffed({0x00, 0x00}), (Bytes{0x01, 0x01, 0x01, 0x00}));
  EXPECT_EQ(stuffed({0x00, 0x11, 0x00}), (Bytes{0x01, 0x02, 0x11, 0x01, 0x00}));
  EXPECT_EQ(stuffed({0x11, 0x22, 0x00, 0x33}), (Bytes{0x03, 0x11, 0x22, 0x02, 0x33, 0x00}));
  EXPECT_EQ(stuffed({0x11, 0x22, 0x33, 0x44}), (Bytes{0x05, 0x11, 0x22, 0x33, 0x44, 0x00}));
  EXPECT_EQ(stuffed({0x11, 0x00, 0x00, 0x00}), (Bytes{0x02, 0x11, 0x01, 0x01, 0x01, 0x00}));
  EXPECT_EQ(stuffed(run(254, 0x01)), with(0xFF, run(254, 0x01), {0x00}));
  EXPECT_EQ(stuffed(with(0x00, run(254, 0x01))), with(0x01, with(0xFF, run(254, 0x01)), {0x00}));
  EXPECT_EQ(stuffed(run(255, 0x01)), with(0xFF, run(254, 0x01), {0x02, 0xFF, 0x00}));
}

/// What a reader makes of bytes off a line: every frame, and an empty one for every break.
std::vector<Bytes> read(const Bytes& line, std::size_t room) {
  Bytes memory(room);
  CobsReader reader(memory);
  std::vector<Bytes> frames;
  for (const std::uint8_t byte : line) {
    const CobsReader::Outcome outcome = reader.take(byte);
    if (outcome == CobsReader::Outcome::kFrame) frames.emplace_back(reader.frame().begin(), reader.frame().end());
    if (outcome == CobsReader::Outcome::kBroken) frames.emplace_back();
  }
  return frames;
}

TEST(Cobs, ComesBackWhateverWasStuffed) {
  Pcg32 random(5);
  for (int trial = 0; trial < 200; ++trial) {
    Bytes bytes(1 + random.next() % 600);
    const std::uint32_t zero_in = 1 + random.next() % 300;
    for (std::uint8_t& byte : bytes) byte = random.next() % zero_in == 0 ? 0 : static_cast<std::uint8_t>(1 + random.next() % 255);
    const std::vector<Bytes> frames = read(stuffed(bytes), bytes.size());
    ASSERT_EQ(frames.size(), 1U);
    EXPECT_EQ(frames[0], bytes);
  }
}

/// In the last bytes of the room that they are stuffed into.
Bytes stuffed_in_place(const Bytes& from) {
  Bytes room(cobs_room(from.size()), 0xEE);
  const std::span<std::uint8_t> last = std::span(room).last(from.size());
  std::copy(from.begin(), from.end(), last.begin());
  room.resize(stuff(last, room));
  return room;
}

TEST(Cobs, StuffsBytesThatLieAtTheEndOfTheirRoomAsIfTheyLayElsewhere) {
  for (const std::size_t size : {1U, 2U, 253U, 254U, 255U, 507U, 508U, 509U, 762U, 3125U}) {
    for (const std::size_t zero_every : {1U, 2U, 254U, 255U, 256U, 100'000U}) {
      Bytes bytes(size);
      for (std::size_t i = 0; i < size; ++i) bytes[i] = (i + 1) % zero_every == 0 ? 0 : static_cast<std::uint8_t>(1 + i % 255);
      EXPECT_EQ(stuffed_in_place(bytes), stuffed(bytes)) << size << " bytes, a zero every " << zero_every;
    }
  }
}

TEST(Cobs, FindsTheNextFrameBehindOneThatLostItsEnd) {
  Bytes line{0x05, 0x11, 0x22};  // of five
  line.push_back(0x00);
  const Bytes good = stuffed({0x33, 0x00, 0x44});
  line.insert(line.end(), good.begin(), good.end());
  EXPECT_EQ(read(line, 64), (std::vector<Bytes>{{}, {0x33, 0x00, 0x44}}));
}

TEST(Cobs, BreaksAFrameThatIsLongerThanItsRoomAndWritesNothingBehindIt) {
  std::array<std::uint8_t, 8> memory{};
  memory.back() = 0xEE;
  CobsReader reader{std::span<std::uint8_t>(memory).first(7)};
  CobsReader::Outcome outcome = CobsReader::Outcome::kNothing;
  for (const std::uint8_t byte : stuffed({1, 2, 3, 4, 5, 6, 7, 8, 9})) outcome = reader.take(byte);
  EXPECT_EQ(outcome, CobsReader::Outcome::kBroken);
  EXPECT_EQ(memory.back(), 0xEE);
}

TEST(Cobs, SaysNothingOfZerosThatWakeALine) {
  EXPECT_TRUE(read({0x00, 0x00, 0x00}, 8).empty());
}

}  // namespace
}  // namespace earshot::wire
