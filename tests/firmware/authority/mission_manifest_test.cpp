#include "firmware/authority/mission_manifest.hpp"

#include <gtest/gtest.h>

#include <array>
#include <string>

namespace earshot::authority {
namespace {

constexpr Sha256 filled_with(std::uint8_t byte) {
  Sha256 hash{};
  for (std::uint8_t& b : hash) b = byte;
  return hash;
}

constexpr Sha256 kMission = filled_with(0xA1);
constexpr Sha256 kPolicy = filled_with(0xB2);
constexpr Sha256 kOther = filled_with(0xC3);

constexpr MissionManifest numbered(std::uint64_t counter) {
  return {.counter = counter, .mission = kMission, .policy = kPolicy};
}

// As on bare metal: no file, no library, nothing but constants of the image.
constexpr std::array<Ed25519Key, 2> kTrusted{filled_with(1), filled_with(2)};
constexpr MissionManifest kFlownLast = numbered(7);
constexpr SignedManifest kSigned{.manifest = numbered(8), .key = kTrusted[1], .signature = {}};

// Python: b"EARSHOT MISSION1" + struct.pack("<Q", 0x0102030405060708) + mission + policy
TEST(MissionManifest, IsSignedAsItsNameItsCounterLittleEndianAndBothHashes) {
  const auto bytes = signed_bytes(numbered(0x0102030405060708U));
  const std::string text(bytes.begin(), bytes.end());
  EXPECT_EQ(text, "EARSHOT MISSION1" + std::string("\x08\x07\x06\x05\x04\x03\x02\x01") + std::string(32, '\xA1') + std::string(32, '\xB2'));
}

TEST(MissionManifest, OfATrustedKeyAndOfTheseBytesIsAccepted) {
  EXPECT_EQ(judge_mission(kSigned, kTrusted, true, kMission), ManifestVerdict::kAccepted);
}

TEST(MissionManifest, OfAKeyThatIsNotTrustedIsRefusedThoughItsSignatureHolds) {
  SignedManifest foreign = kSigned;
  foreign.key = kOther;
  EXPECT_EQ(judge_mission(foreign, kTrusted, true, kMission), ManifestVerdict::kForeignKey);
  EXPECT_EQ(judge_mission(kSigned, {}, true, kMission), ManifestVerdict::kForeignKey);
}

TEST(MissionManifest, WhoseSignatureDoesNotHoldIsRefused) {
  EXPECT_EQ(judge_mission(kSigned, kTrusted, false, kMission), ManifestVerdict::kFalseSignature);
}

TEST(MissionManifest, OfOtherBytesIsRefused) {
  EXPECT_EQ(judge_mission(kSigned, kTrusted, true, kOther), ManifestVerdict::kOtherMission);
}

TEST(MissionManifest, IsFlownWithTheVeryPolicyAlone) {
  EXPECT_EQ(judge_flight(numbered(8), kPolicy, kFlownLast), ManifestVerdict::kAccepted);
  EXPECT_EQ(judge_flight(numbered(8), kOther, kFlownLast), ManifestVerdict::kOtherPolicy);
}

TEST(MissionManifest, IsRefusedBelowTheCounterThatFlewLast) {
  EXPECT_EQ(judge_flight(numbered(6), kPolicy, kFlownLast), ManifestVerdict::kRolledBack);
  EXPECT_EQ(judge_flight(numbered(1), kPolicy, {}), ManifestVerdict::kAccepted) << "none has flown";
  EXPECT_EQ(judge_flight(numbered(0), kPolicy, {}), ManifestVerdict::kRolledBack) << "0 is no mission's";
}

TEST(MissionManifest, RaisesTheCounterByNoMoreThanLeavesNumbersForAllLaterMissions) {
  EXPECT_EQ(judge_flight(numbered(9'223'372'036'854'775'807U), kPolicy, kFlownLast), ManifestVerdict::kTooFarAhead) << "2^63 - 1";
  EXPECT_EQ(judge_flight(numbered(18'446'744'073'709'551'615U), kPolicy, kFlownLast), ManifestVerdict::kTooFarAhead) << "2^64 - 1";
  EXPECT_EQ(judge_flight(numbered(4'294'967'296U + 7U), kPolicy, kFlownLast), ManifestVerdict::kAccepted) << "2^32 further";
  EXPECT_EQ(judge_flight(numbered(4'294'967'296U + 8U), kPolicy, kFlownLast), ManifestVerdict::kTooFarAhead);
  EXPECT_EQ(judge_flight(numbered(1'795'000'000U), kPolicy, {}), ManifestVerdict::kAccepted) << "counted by the seconds since 1970, from 0";
  const MissionManifest high = numbered(9'223'372'036'854'775'807U);
  EXPECT_EQ(judge_flight(high, kPolicy, high), ManifestVerdict::kAccepted) << "what flew already is flown on";
}

TEST(MissionManifest, WithTheCounterThatFlewLastIsFlownAgainOnlyIfNothingElseHasChanged) {
  EXPECT_EQ(judge_flight(numbered(7), kPolicy, kFlownLast), ManifestVerdict::kAccepted);
  MissionManifest changed = numbered(7);
  changed.mission = kOther;
  EXPECT_EQ(judge_flight(changed, kPolicy, kFlownLast), ManifestVerdict::kCounterInUse);
  changed = numbered(7);
  changed.policy = kOther;
  EXPECT_EQ(judge_flight(changed, kOther, kFlownLast), ManifestVerdict::kCounterInUse);
}

}  // namespace
}  // namespace earshot::authority
