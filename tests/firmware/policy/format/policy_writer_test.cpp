#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <functional>
#include <limits>
#include <string_view>

#include "tests/firmware/policy/format/policy_bytes.hpp"

namespace earshot::policy {
namespace {

std::string_view text_at(const Bytes& bytes, std::size_t at, std::size_t size) {
  return {reinterpret_cast<const char*>(bytes.data()) + at, size};
}

TEST(Serialise, LaysThePolicyOutAsTheReadmeSays) {
  const Bytes bytes = bytes_of(*small_policy());
  ASSERT_EQ(bytes.size(), kSizeInAll);
  EXPECT_EQ(text_at(bytes, 0, 8), "EARSHOTP");
  EXPECT_EQ(value_at<std::uint32_t>(bytes, kVersionAt), 4U);
  EXPECT_EQ(value_at<std::uint32_t>(bytes, kLengthAt), kSizeInAll);
  EXPECT_EQ(bytes[kActionCountAt], 4);
  EXPECT_EQ(value_at<double>(bytes, kAreaNorthAt), 25000.0);
  EXPECT_EQ(value_at<double>(bytes, kAreaEastAt), 26000.0);
  EXPECT_EQ(value_at<double>(bytes, kThresholdAt), -3.5);
  EXPECT_EQ(value_at<double>(bytes, kStepLengthAt), 1000.0);
  EXPECT_EQ(value_at<double>(bytes, kDirectionsAt + 3 * 16), 0.6);
  EXPECT_EQ(bytes[kDrawAt], 2);
  EXPECT_EQ(text_at(bytes, kProvenanceAt, kProvenance.size()), kProvenance);
  EXPECT_EQ(value_at<double>(bytes, kFirstStepAt), 1000.0);
  EXPECT_EQ(value_at<double>(bytes, kFirstStepAt + 8), 2000.0);
  EXPECT_EQ(value_at<double>(bytes, kFirstStepAt + 16), 1.0);
  EXPECT_EQ(bytes[kPublicKeyAt], 1);
  EXPECT_EQ(std::count(bytes.end() - kSignatureSize, bytes.end(), 0), 64);  // the signature is somebody else's to write
}

TEST(Serialise, WritesTheListeningWindowInSeconds) {
  const auto policy = small_policy();
  policy->observation.listening = {config::Listening::kLoudest, Duration::seconds(30)};
  const Bytes bytes = bytes_of(*policy);
  EXPECT_EQ(bytes[kListeningAt], 1);
  EXPECT_EQ(value_at<std::uint16_t>(bytes, kListeningAt + 1), 30);
}

TEST(Serialise, NamesEverySectionWithItsVersionAndLength) {
  struct Expected {
    std::size_t at;
    std::string_view tag;
    int version;
    std::uint32_t length;
  };
  const Bytes bytes = bytes_of(*small_policy());
  for (const Expected& section :
       {Expected{kNetworkAt, "NETW", 2, 203}, Expected{kObservationAt, "OBSV", 1, 48}, Expected{kActionsAt, "ACTN", 1, 73},
        Expected{kDrawSectionAt, "DRAW", 1, 1}, Expected{kBeliefAt, "BELF", 2, 0}, Expected{kProvenanceSectionAt, "PROV", 1, 24},
        Expected{kGoldenSectionAt, "GOLD", 1, 1214}}) {
    EXPECT_EQ(text_at(bytes, section.at, 4), section.tag);
    EXPECT_EQ(value_at<std::uint16_t>(bytes, section.at + 4), section.version);
    EXPECT_EQ(value_at<std::uint32_t>(bytes, section.at + 6), section.length);
  }
}

/// Section by section as README.md has it: 16 of header, NETW 10 + 3, OBSV 10 + 28 + 5 10, ACTN 10 + 73, DRAW 10 + 1, then BELF.
TEST(Serialise, WritesOfTheBeliefItsSettingsAlone) {
  const Bytes bytes = bytes_of(*advising_policy());
  const std::size_t belief_at = 16 + 13 + 88 + 83 + 11;
  EXPECT_EQ(text_at(bytes, belief_at, 4), "BELF");
  EXPECT_EQ(value_at<std::uint32_t>(bytes, belief_at + 6), 40U);
  EXPECT_EQ(value_at<std::uint16_t>(bytes, belief_at + 10), 49);
  EXPECT_EQ(value_at<std::uint16_t>(bytes, belief_at + 12), 51);
  EXPECT_EQ(value_at<double>(bytes, belief_at + 14), 700.0);
  const std::array floats{0.125F, 2.5F, -0.25F, 20.0F, 0.75F, 50.0F, 9.0F};  // outliers, then what a search costs
  for (std::size_t i = 0; i < floats.size(); ++i) EXPECT_EQ(value_at<float>(bytes, belief_at + 22 + 4 * i), floats[i]) << i;
}

TEST(Serialise, WritesOfANetworkThatThereIsNotItsSizesAlone) {
  const Bytes bytes = bytes_of(*advising_policy());
  EXPECT_EQ(text_at(bytes, kNetworkAt, 4), "NETW");
  EXPECT_EQ(value_at<std::uint32_t>(bytes, kNetworkAt + 6), 3U);
  EXPECT_EQ(bytes[kActivationAt], 0);
  EXPECT_EQ(bytes[kActivationAt + 1], 5);  // elements
  EXPECT_EQ(bytes[kActivationAt + 2], 4);  // actions
}

TEST(Serialise, FillsTheLargestSerialisedSizeWithThePolicyOfTheLargestSizes) {
  const auto policy = std::make_unique<FrozenPolicy>();
  while (policy->observation.spec.push_back({.feature = Feature::kFound}) == Status::kOk) {
  }
  while (policy->actions.push_back({}) == Status::kOk) {
  }
  while (policy->provenance.push_back('x') == Status::kOk) {
  }
  policy->step_length = Meters{1};
  policy->area_size = {.north = Meters{1}, .east = Meters{1}};
  BeliefModel& belief = policy->observation.belief;
  belief.actions = policy->actions;
  belief.step_length = policy->step_length;
  belief.area_size = policy->area_size;
  belief.detection_threshold = policy->detection_threshold;
  policy->network.observation_size = config::kMaxObservation;
  policy->network.hidden_sizes = {Network::kWidth, Network::kWidth, Network::kWidth};
  if (!fits(policy->network)) policy->network.hidden_sizes = {Network::kWidth, Network::kWidth};
  policy->network.action_count = config::kMaxActions;
  const Bytes bytes = bytes_of(*policy);
  EXPECT_EQ(bytes.size(), max_serialised_size());
  EXPECT_TRUE(complaint_about(bytes).is_none());
}

TEST(Serialise, RefusesAPolicyThatParseWouldRefuse) {
  Bytes bytes(max_serialised_size());
  const auto refused = [&bytes](const std::function<void(FrozenPolicy&)>& damage) {
    const auto policy = small_policy();
    damage(*policy);
    return serialise(*policy, kPublicKey, bytes).status();
  };
  EXPECT_EQ(refused([](FrozenPolicy& policy) { policy.network.observation_size = 3; }), Status::kOutOfRange);
  EXPECT_EQ(refused([](FrozenPolicy& policy) { policy.network.layer(1).bias[2] = std::numeric_limits<float>::infinity(); }),
            Status::kOutOfRange);
}

TEST(Serialise, SaysFullWhereverTheBytesEnd) {
  const auto policy = small_policy();
  for (std::size_t size = 0; size < kSizeInAll; ++size) {
    Bytes bytes(size);
    ASSERT_EQ(serialise(*policy, kPublicKey, bytes).status(), Status::kFull) << size;
  }
}

}  // namespace
}  // namespace earshot::policy
