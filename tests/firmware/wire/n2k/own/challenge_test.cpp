#include "firmware/wire/n2k/own/challenge.hpp"
#include "firmware/wire/n2k/table/messages.hpp"

#include <gtest/gtest.h>

#include <numeric>
#include <vector>

namespace earshot::n2k {
namespace {

std::vector<std::uint8_t> bytes_on_bus(const messages::PublishedChallenge& published) {
  FastPacketFrames frames;
  EXPECT_EQ(compose_challenge(published, {.source = 0x40}, frames), Status::kOk);
  FastPacketAssembly assembly;
  std::span<const std::uint8_t> bytes;
  for (const Frame& frame : frames) static_cast<void>(assembly.accept({.pgn = kChallengePgn, .source = 0x40}, frame, bytes));
  return {bytes.begin(), bytes.end()};
}

TEST(ChallengeMessage, LiesByteForByteWhereOtherProgramsExpectIt) {
  messages::PublishedChallenge published{.time = Time{0x0807060504030201}, .challenge = {}};
  std::iota(published.challenge.nonce.begin(), published.challenge.nonce.end(), std::uint8_t{0x10});
  std::iota(published.challenge.vehicle.begin(), published.challenge.vehicle.end(), std::uint8_t{0x40});
  std::iota(published.challenge.mission.begin(), published.challenge.mission.end(), std::uint8_t{0x80});
  std::iota(published.mark.begin(), published.mark.end(), std::uint8_t{0xF0});
  std::vector<std::uint8_t> expected{0xFC, 0x9F, 1, 2, 3, 4, 5, 6, 7, 8};
  for (const auto& [first, count] : {std::pair{0x10, 16}, {0x40, 32}, {0x80, 32}, {0xF0, 16}}) {
    for (int i = 0; i < count; ++i) expected.push_back(static_cast<std::uint8_t>(first + i));
  }
  ASSERT_EQ(expected.size(), 106U);
  EXPECT_EQ(bytes_on_bus(published), expected);
  EXPECT_EQ(read_challenge(expected).value(), published);
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
