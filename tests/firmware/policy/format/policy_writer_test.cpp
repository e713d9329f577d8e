#include <gtest/gtest.h>

#include <algorithm>
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
    std::uint32_t length;
  };
  const Bytes bytes = bytes_of(*small_policy());
  for (const Expected& section : {Expected{kNetworkAt, "NETW", 203}, Expected{kObservationAt, "OBSV", 48}, Expected{kActionsAt, "ACTN", 73},
                                  Expected{kDrawSectionAt, "DRAW", 1}, Expected{kBeliefAt, "BELF", 0},
                                  Expected{kProvenanceSectionAt, "PROV", 24}, Expected{kGoldenSectionAt, "GOLD", 1214}}) {
    EXPECT_EQ(text_at(bytes, section.at, 4), section.tag);
    EXPECT_EQ(value_at<std::uint16_t>(bytes, section.at + 4), 1);
    EXPECT_EQ(value_at<std::uint32_t>(bytes, section.at + 6), section.length);
  }
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
  while (belief.hypotheses.push_back({}) == Status::kOk) {
  }
  while (belief.snr_db.push_back(0.0F) == Status::kOk) {
  }
  belief.actions = policy->actions;
  belief.step_length = policy->step_length;
  belief.area_size = policy->area_size;
  belief.detection_threshold = policy->detection_threshold;
  policy->network.observation_size = config::kMaxObservation;
  policy->network.hidden_sizes = {Network::kWidth, Network::kWidth};
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
  EXPECT_EQ(refused([](FrozenPolicy& policy) { policy.network.second.bias[2] = std::numeric_limits<float>::infinity(); }),
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
