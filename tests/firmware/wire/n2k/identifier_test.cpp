#include "firmware/wire/n2k/identifier.hpp"

#include <gtest/gtest.h>

#include "tests/firmware/wire/n2k/recorded_bus.hpp"

namespace earshot::n2k {
namespace {

TEST(Identifier, ReadsAndWritesThoseOfARecordedBus) {
  ASSERT_FALSE(recorded_bus().empty());
  for (const Recorded& message : recorded_bus()) {
    const Result<Identifier> parsed = parse_identifier(message.frames[0].identifier);
    ASSERT_TRUE(parsed.ok());
    EXPECT_EQ(parsed.value().pgn, message.pgn);
    EXPECT_EQ(parsed.value().priority, message.priority);
    EXPECT_EQ(parsed.value().source, message.source);
    EXPECT_EQ(parsed.value().destination, message.destination);
    EXPECT_EQ(compose(parsed.value()).value(), message.frames[0].identifier);
  }
}

TEST(Identifier, TakesTheDestinationOfAnAddressedGroupOutOfThePgn) {
  // ISO request from 172 to 204, candumpSample3.txt: 18EACCAC.
  const Identifier request{.pgn = 59904, .priority = 6, .source = 172, .destination = 204};
  EXPECT_EQ(parse_identifier(0x18EACCAC).value(), request);
  EXPECT_EQ(compose(request).value(), 0x18EACCACU);
}

TEST(Identifier, RefusesWhatTwentyNineBitsCannotSay) {
  EXPECT_EQ(parse_identifier(0x20000000).status(), Status::kOutOfRange);
  EXPECT_EQ(compose({.pgn = 129025, .priority = 8}).status(), Status::kOutOfRange);
  EXPECT_EQ(compose({.pgn = 0x40000}).status(), Status::kOutOfRange);
  EXPECT_EQ(compose({.pgn = 59905}).status(), Status::kOutOfRange) << "an addressed group has no low byte";
  EXPECT_EQ(compose({.pgn = 129025, .destination = 3}).status(), Status::kOutOfRange) << "a broadcast group has no destination";
}

TEST(Identifier, TakesTheHighestNumbersThatFit) {
  // Priority 7 in bits 26 to 28, then 18 ones, then the source.
  EXPECT_EQ(compose({.pgn = 0x3FFFF, .priority = 7, .source = 0x40}).value(), 0x1FFFFF40U);
  EXPECT_EQ(parse_identifier(0x1FFFFFFF).value(), (Identifier{.pgn = 0x3FFFF, .priority = 7, .source = 0xFF}));
  // Formats from 240 on have no destination: 0xF000 = 61440 is the first such group, 0xEF00 = 61184 the last with one.
  EXPECT_EQ(compose({.pgn = 0xF000, .source = 0x40, .destination = 3}).status(), Status::kOutOfRange);
  EXPECT_EQ(compose({.pgn = 0xEF00, .priority = 6, .source = 0x40, .destination = 3}).value(), 0x18EF0340U);
}

TEST(Identifier, IsThatOfADeviceWithoutAnAddressWhoSpeaksToAllUnlessToldOtherwise) {
  EXPECT_EQ(compose(Identifier{.pgn = 59904}).value(), 0x18EAFFFEU) << "priority 6, to 255, from 254";
}

TEST(Identifier, SurvivesTheRoundTripOfAll29BitNumbersSampled) {
  for (std::uint32_t id = 0; id <= 0x1FFFFFFFU - 9973U; id += 9973U) ASSERT_EQ(compose(parse_identifier(id).value()).value(), id);
}

}  // namespace
}  // namespace earshot::n2k
