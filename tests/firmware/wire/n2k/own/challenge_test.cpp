#include "firmware/wire/n2k/own/challenge.hpp"

#include <gtest/gtest.h>

#include <numeric>
#include <vector>

namespace earshot::n2k {
namespace {

std::vector<std::uint8_t> bytes_on_bus(const messages::ToldChallenge& told) {
  FastPacketFrames frames;
  EXPECT_EQ(compose_challenge(told, {.source = 0x40}, frames), Status::kOk);
  FastPacketAssembly assembly;
  std::span<const std::uint8_t> bytes;
  for (const Frame& frame : frames) static_cast<void>(assembly.accept({.pgn = kChallengePgn, .source = 0x40}, frame, bytes));
  return {bytes.begin(), bytes.end()};
}

TEST(ChallengeMessage, LiesByteForByteWhereOtherProgramsExpectIt) {
  messages::ToldChallenge told{.time = Time{0x0807060504030201}, .challenge = {}};
  std::iota(told.challenge.nonce.begin(), told.challenge.nonce.end(), std::uint8_t{0x10});
  std::iota(told.challenge.vehicle.begin(), told.challenge.vehicle.end(), std::uint8_t{0x40});
  std::iota(told.challenge.mission.begin(), told.challenge.mission.end(), std::uint8_t{0x80});
  std::iota(told.mark.begin(), told.mark.end(), std::uint8_t{0xF0});
  std::vector<std::uint8_t> expected{0xFC, 0x9F, 1, 2, 3, 4, 5, 6, 7, 8};
  for (const auto& [first, count] : {std::pair{0x10, 16}, {0x40, 32}, {0x80, 32}, {0xF0, 16}}) {
    for (int i = 0; i < count; ++i) expected.push_back(static_cast<std::uint8_t>(first + i));
  }
  ASSERT_EQ(expected.size(), 106U);
  EXPECT_EQ(bytes_on_bus(told), expected);
  EXPECT_EQ(read_challenge(expected).value(), told);
}

TEST(ChallengeMessage, OfAnotherMakerOrCutShortIsNone) {
  std::vector<std::uint8_t> bytes = bytes_on_bus({.time = Time{1}, .challenge = {}});
  std::vector<std::uint8_t> cut(bytes.begin(), bytes.end() - 1);
  EXPECT_EQ(read_challenge(cut).status(), Status::kMalformed);
  bytes[0] = 0x3F;
  EXPECT_EQ(read_challenge(bytes).status(), Status::kUnsupported);
}

}  // namespace
}  // namespace earshot::n2k
