#include <gtest/gtest.h>

#include <algorithm>
#include <string_view>
#include <tuple>

#include "tests/firmware/not_finite.hpp"
#include "tests/firmware/policy/format/policy_bytes.hpp"

namespace earshot::policy {
namespace {

using tests::kNan;

bool is(const PolicyComplaint& complaint, PolicyFault fault, std::string_view section) {
  return complaint.fault == fault && std::string_view(complaint.section.data(), complaint.section.size()) == section;
}

TEST(Parse, GivesThePolicyBackAsItWas) {
  const auto before = small_policy();
  const Bytes bytes = bytes_of(*before);
  const auto after = std::make_unique<FrozenPolicy>();
  PolicyComplaint complaint;
  ASSERT_EQ(parse(bytes, *after, complaint), Status::kOk);
  EXPECT_TRUE(complaint.is_none());
  EXPECT_TRUE(std::ranges::equal(after->observation.spec, before->observation.spec));
  EXPECT_TRUE(std::ranges::equal(after->actions, before->actions));
  EXPECT_TRUE(std::ranges::equal(after->provenance, before->provenance));
  EXPECT_EQ(std::tuple(after->step_length, after->area_size, after->detection_threshold, after->draw),
            std::tuple(before->step_length, before->area_size, before->detection_threshold, before->draw));
  EXPECT_EQ(after->network.hidden_sizes, before->network.hidden_sizes);
  EXPECT_EQ(after->network.activation, before->network.activation);
  EXPECT_EQ(after->network.numbers, before->network.numbers);
  EXPECT_TRUE(repeats(*after));
  EXPECT_EQ(bytes_of(*after), bytes);
}

TEST(Parse, MayReplaceALargerPolicyInPlace) {
  const auto policy = believing_policy();
  policy->observation.spec = memory_state(21, Meters{1000}, Decibels{10}).value();
  policy->network.observation_size = 63;
  record(*policy);
  const Bytes bytes = bytes_of(*small_policy());
  PolicyComplaint complaint;
  ASSERT_EQ(parse(bytes, *policy, complaint), Status::kOk);
  EXPECT_EQ(policy->observation.spec.size(), 2U);
  EXPECT_TRUE(repeats(*policy));
  EXPECT_EQ(bytes_of(*policy), bytes);
}

TEST(Parse, GivesTheBeliefBackWithItsCosts) {
  const auto before = believing_policy();
  const Bytes bytes = bytes_of(*before);
  EXPECT_EQ(bytes.size(), kSizeInAll + 40);
  const auto after = std::make_unique<FrozenPolicy>();
  PolicyComplaint complaint;
  ASSERT_EQ(parse(bytes, *after, complaint), Status::kOk);
  const BeliefModel& a = after->observation.belief;
  const BeliefModel& b = before->observation.belief;
  EXPECT_EQ(a.costs, b.costs);
  EXPECT_TRUE(std::ranges::equal(a.actions, b.actions));
  EXPECT_EQ(std::tuple(a.cells_north, a.cells_east, a.border_width, a.outlier_share), std::tuple(49, 51, Meters{700}, 0.125F));
  EXPECT_EQ(std::tuple(a.area_size, a.step_length, a.detection_threshold), std::tuple(b.area_size, b.step_length, b.detection_threshold));
  EXPECT_TRUE(repeats(*after));
  EXPECT_EQ(bytes_of(*after), bytes);
}

TEST(Parse, MayReplaceABeliefInPlace) {
  const Bytes bytes = bytes_of(*believing_policy());
  const auto policy = believing_policy();
  PolicyComplaint complaint;
  ASSERT_EQ(parse(bytes, *policy, complaint), Status::kOk);
  EXPECT_EQ(bytes_of(*policy), bytes);
}

TEST(Parse, GivesAPolicyWithoutANetworkBackInPlaceOfOneWithOne) {
  const auto before = advising_policy();
  const Bytes bytes = bytes_of(*before);
  const auto after = small_policy();
  PolicyComplaint complaint;
  ASSERT_EQ(parse(bytes, *after, complaint), Status::kOk);
  EXPECT_FALSE(has_network(after->network));
  EXPECT_EQ(after->network.observation_size, 5U);
  EXPECT_EQ(after->network.action_count, 4U);
  EXPECT_TRUE(repeats(*after));
  EXPECT_EQ(bytes_of(*after), bytes);
}

TEST(Parse, RefusesAPolicyWithoutANetworkThatDoesNotShowItsPreferences) {
  Bytes bytes = bytes_of(*advising_policy());
  const std::size_t second_element = kNetworkAt + 10 + 3 + 10 + 28 + 10;  // the preference of action 3
  ASSERT_EQ(bytes[second_element], 37);
  bytes[second_element] = 33;  // its reach
  mend(bytes);
  EXPECT_TRUE(is(complaint_about(bytes), PolicyFault::kNoAdvice, "OBSV"));
}

/// small_policy() with another network of numbers that differ. Its file says form, activation, inputs, number of layers, layers, actions.
std::unique_ptr<FrozenPolicy> policy_with(std::array<std::size_t, 3> hidden, Activation activation) {
  auto policy = small_policy();
  policy->network.hidden_sizes = hidden;
  policy->network.activation = activation;
  for (std::size_t l = 0; l <= policy->network.hidden_count(); ++l) {
    const Network::Layer layer = policy->network.layer(l);
    std::ranges::fill(layer.packed, 0.0F);
    std::ranges::fill(layer.bias, 0.0F);
    for (std::size_t o = 0; o < layer.outputs; ++o) {
      for (std::size_t i = 0; i < layer.inputs; ++i)
        layer.weight(o, i) = 0.1F * static_cast<float>(l + 1) - 0.01F * static_cast<float>(o + 3 * i);
      layer.bias[o] = 0.02F * static_cast<float>(o);
    }
  }
  record(*policy);
  return policy;
}

TEST(Parse, GivesNetworksOfOneToThreeLayersBack) {
  const auto after = std::make_unique<FrozenPolicy>();
  for (const Activation activation : {Activation::kTanh, Activation::kRelu}) {
    for (const std::array<std::size_t, 3> hidden : {std::array<std::size_t, 3>{7}, {5, 3}, {5, 3, 6}}) {
      const auto before = policy_with(hidden, activation);
      const Bytes bytes = bytes_of(*before);
      PolicyComplaint complaint;
      ASSERT_EQ(parse(bytes, *after, complaint), Status::kOk);
      EXPECT_EQ(after->network.hidden_sizes, hidden);
      EXPECT_EQ(after->network.activation, activation);
      EXPECT_TRUE(repeats(*after));
      EXPECT_EQ(bytes_of(*after), bytes);
    }
  }
}

TEST(Parse, RefusesLayersAndActivationsThatNobodyHas) {
  // 2 (its layers stated), 2 (ReLU), 2 inputs, 3 layers, their units in two bytes each, 4 actions.
  const Bytes good = bytes_of(*policy_with({5, 3, 6}, Activation::kRelu));
  const Bytes stated{2, 2, 2, 3, 5, 0, 3, 0, 6, 0, 4};
  ASSERT_TRUE(std::ranges::equal(stated, std::span(good).subspan(kActivationAt, stated.size())));
  const auto with = [&good](std::size_t at, std::uint8_t value) {
    Bytes bytes = good;
    bytes[kActivationAt + at] = value;
    mend(bytes);
    return complaint_about(bytes);
  };
  for (const std::uint8_t form : Bytes{3, 128, 255}) EXPECT_TRUE(is(with(0, form), PolicyFault::kUnknownActivation, "NETW")) << int{form};
  for (const std::uint8_t activation : Bytes{0, 3, 255})
    EXPECT_TRUE(is(with(1, activation), PolicyFault::kUnknownActivation, "NETW")) << int{activation};
  for (const std::uint8_t count : Bytes{0, 4, 128, 255}) EXPECT_TRUE(is(with(3, count), PolicyFault::kBadShape, "NETW")) << int{count};
  for (const std::uint8_t count : Bytes{1, 2}) EXPECT_FALSE(with(3, count).is_none()) << int{count};
  for (const std::size_t layer : {0U, 1U, 2U}) EXPECT_TRUE(is(with(4 + 2 * layer, 0), PolicyFault::kBadShape, "NETW")) << layer;
  EXPECT_TRUE(is(with(2, 65), PolicyFault::kBadShape, "NETW"));
  EXPECT_TRUE(is(with(10, 33), PolicyFault::kBadShape, "NETW"));
  // The high byte: 65 285, 65 283 and 65 286 units.
  for (const std::size_t layer : {0U, 1U, 2U}) EXPECT_TRUE(is(with(5 + 2 * layer, 255), PolicyFault::kTooLarge, "NETW")) << layer;
  // 65 344 places for 65 285 units: of 2 inputs, then into 64 places of the second layer; 64 of the third, and 8 of the output.
  EXPECT_EQ(with(5, 255).size, 4U * (65'344ULL * 3 + 64ULL * 65'286 + 64 * 4 + 8 * 7));
}

TEST(Parse, NamesANetworkOfTheFormatBefore) {
  const PolicyComplaint complaint = complaint_after([](Bytes& bytes) { bytes[kNetworkAt + 4] = 1; });
  EXPECT_TRUE(is(complaint, PolicyFault::kUnknownSectionVersion, "NETW"));
  EXPECT_EQ(complaint.version, 1U);
}

TEST(Parse, GivesThePolicyOfTheSmallestSizesBack) {
  const auto policy = small_policy();
  policy->network.observation_size = policy->network.action_count = 1;
  policy->network.hidden_sizes = {1, 1};
  const ObservationElement element = policy->observation.spec[0];
  policy->observation.spec.clear();
  policy->actions.clear();
  ASSERT_EQ(policy->observation.spec.push_back(element), Status::kOk);
  ASSERT_EQ(policy->actions.push_back({1, 0}), Status::kOk);
  for (GoldenTrajectory& trajectory : policy->golden) {
    for (GoldenStep& step : trajectory) step = {.place = step.place, .reception = step.reception, .belief = {}};
  }
  record(*policy);
  const Bytes bytes = bytes_of(*policy);
  PolicyComplaint complaint;
  const auto after = std::make_unique<FrozenPolicy>();
  ASSERT_EQ(parse(bytes, *after, complaint), Status::kOk);
  EXPECT_TRUE(repeats(*after));
  EXPECT_EQ(bytes_of(*after), bytes);
}

TEST(Parse, GivesTheListeningWindowBack) {
  const auto before = small_policy();
  before->observation.listening = {config::Listening::kMean, Duration::seconds(120)};
  const auto after = small_policy();
  PolicyComplaint complaint;
  ASSERT_EQ(parse(bytes_of(*before), *after, complaint), Status::kOk);
  EXPECT_EQ(after->observation.listening, before->observation.listening);
}

TEST(Parse, FindsAFileTooShortWhereverItIsCut) {
  const Bytes bytes = bytes_of(*small_policy());
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    const PolicyComplaint complaint = complaint_about(std::span(bytes).first(size));
    ASSERT_EQ(complaint.fault, PolicyFault::kTooShort) << size;
  }
}

TEST(Parse, FindsAFileTooShortThatSaysItIsNoLongerThanItsHeaderAndTrailer) {
  const Bytes whole = bytes_of(*small_policy());
  for (std::size_t size = 16; size <= 116; ++size) {  // 16 + 100: all but the sections
    Bytes bytes(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size));
    put(bytes, kLengthAt, static_cast<std::uint32_t>(size));
    if (size >= 16 + 4 + 64) mend(bytes);
    const PolicyComplaint complaint = complaint_about(bytes);
    EXPECT_EQ(complaint.fault, size < 116 ? PolicyFault::kTooShort : PolicyFault::kMissingSection) << size;
  }
}

TEST(Parse, RefusesBytesBehindTheEnd) {
  Bytes bytes = bytes_of(*small_policy());
  bytes.push_back(0);
  EXPECT_EQ(complaint_about(bytes).fault, PolicyFault::kTooLong);
}

TEST(Parse, RefusesAnyBitFlippedBeforeTheSignature) {
  Bytes bytes = bytes_of(*small_policy());
  for (std::size_t bit = 0; bit < 8 * (bytes.size() - kSignatureSize); ++bit) {
    const auto mask = static_cast<std::uint8_t>(1U << (bit % 8));
    bytes[bit / 8] ^= mask;
    EXPECT_FALSE(complaint_about(bytes).is_none()) << bit;
    bytes[bit / 8] ^= mask;
  }
}

TEST(Parse, LeavesTheSignatureToTheShell) {
  Bytes bytes = bytes_of(*small_policy());
  bytes.back() = 0xAA;
  EXPECT_TRUE(complaint_about(bytes).is_none());
}

TEST(Parse, NamesWhatIsWrongAboutTheSections) {
  EXPECT_EQ(complaint_after([](Bytes& bytes) { bytes[0] = 'e'; }).fault, PolicyFault::kBadMagic);
  for (const std::uint8_t version : Bytes{3, 5}) {
    const PolicyComplaint complaint = complaint_after([version](Bytes& bytes) { bytes[kVersionAt] = version; });
    EXPECT_EQ(complaint.fault, PolicyFault::kUnknownVersion);
    EXPECT_EQ(complaint.version, version);
  }
  Bytes damaged = bytes_of(*small_policy());
  damaged[kChecksumAt] ^= 1U;
  EXPECT_EQ(complaint_about(damaged).fault, PolicyFault::kBadChecksum);
}

/// Moves, copies or drops the bytes [begin, end).
Bytes piece(const Bytes& bytes, std::size_t begin, std::size_t end) {
  return {bytes.begin() + static_cast<std::ptrdiff_t>(begin), bytes.begin() + static_cast<std::ptrdiff_t>(end)};
}
void insert(Bytes& bytes, std::size_t at, const Bytes& what) {
  bytes.insert(bytes.begin() + static_cast<std::ptrdiff_t>(at), what.begin(), what.end());
}
void erase(Bytes& bytes, std::size_t begin, std::size_t end) {
  bytes.erase(bytes.begin() + static_cast<std::ptrdiff_t>(begin), bytes.begin() + static_cast<std::ptrdiff_t>(end));
}

TEST(Parse, NamesASectionThatItDoesNotKnow) {
  EXPECT_TRUE(is(complaint_after([](Bytes& bytes) { bytes[kActionsAt] = 'X'; }), PolicyFault::kUnknownSection, "XCTN"));
  EXPECT_TRUE(is(complaint_after([](Bytes& bytes) {
                   insert(bytes, kPublicKeyAt, {'E', 'X', 'T', 'R', 1, 0, 0, 0, 0, 0});
                 }),
                 PolicyFault::kUnknownSection, "EXTR"));
  EXPECT_TRUE(is(complaint_after([](Bytes& bytes) { insert(bytes, kPublicKeyAt, {'N'}); }), PolicyFault::kUnknownSection,
                 std::string_view("N\0\0\0", 4)));
}

TEST(Parse, NamesASectionOfAnotherVersion) {
  const PolicyComplaint complaint = complaint_after([](Bytes& bytes) { bytes[kBeliefAt + 4] = 1; });
  EXPECT_TRUE(is(complaint, PolicyFault::kUnknownSectionVersion, "BELF"));
  EXPECT_EQ(complaint.version, 1U) << "of the belief in one ocean";
}

TEST(Parse, NamesASectionThatIsMissing) {
  EXPECT_TRUE(is(complaint_after([](Bytes& bytes) { erase(bytes, kDrawSectionAt, kBeliefAt); }), PolicyFault::kMissingSection, "DRAW"));
  EXPECT_TRUE(
      is(complaint_after([](Bytes& bytes) { erase(bytes, kGoldenSectionAt, kPublicKeyAt); }), PolicyFault::kMissingSection, "GOLD"));
}

TEST(Parse, NamesASectionThatIsNotInItsPlace) {
  const auto swap = [](Bytes& bytes) {
    const Bytes draw = piece(bytes, kDrawSectionAt, kBeliefAt);
    erase(bytes, kDrawSectionAt, kBeliefAt);
    insert(bytes, kActionsAt, draw);
  };
  EXPECT_TRUE(is(complaint_after(swap), PolicyFault::kMissingSection, "ACTN"));
}

TEST(Parse, NamesASectionThatStandsThereTwice) {
  EXPECT_TRUE(is(complaint_after([](Bytes& bytes) { insert(bytes, kBeliefAt, piece(bytes, kDrawSectionAt, kBeliefAt)); }),
                 PolicyFault::kSectionTwice, "DRAW"));
  EXPECT_TRUE(is(complaint_after([](Bytes& bytes) { insert(bytes, kPublicKeyAt, piece(bytes, kDrawSectionAt, kBeliefAt)); }),
                 PolicyFault::kSectionTwice, "DRAW"));
}

TEST(Parse, NamesASectionThatIsNotAsLongAsWhatItHolds) {
  for (const std::uint32_t length : {0U, 72U, 74U, 2'000U, 0xFFFFFFFFU})
    EXPECT_TRUE(is(complaint_after([length](Bytes& bytes) { put(bytes, kActionsAt + 6, length); }), PolicyFault::kBadSectionLength, "ACTN"))
        << length;
  const auto unseen_belief = [](Bytes& bytes) {
    put(bytes, kBeliefAt + 6, std::uint32_t{1});
    insert(bytes, kBeliefAt + 10, {0});
  };
  EXPECT_TRUE(is(complaint_after(unseen_belief), PolicyFault::kBadSectionLength, "BELF"));
}

TEST(Parse, NamesALastSectionThatSaysItIsLongerThanTheFile) {
  for (const std::uint32_t length : {1'213U, 1'215U, 0xFFFFFFFFU})
    EXPECT_TRUE(
        is(complaint_after([length](Bytes& bytes) { put(bytes, kGoldenSectionAt + 6, length); }), PolicyFault::kBadSectionLength, "GOLD"))
        << length;
}

TEST(Parse, NamesWhatIsWrongInASection) {
  EXPECT_TRUE(is(complaint_after([](Bytes& bytes) { bytes[kActivationAt] = 3; }), PolicyFault::kUnknownActivation, "NETW"));
  EXPECT_TRUE(is(complaint_after([](Bytes& bytes) { bytes[kActivationAt] = 0; }), PolicyFault::kBadSectionLength, "NETW"))
      << "layers without a network";
  for (const std::uint8_t count : Bytes{0, 5, 33})
    EXPECT_EQ(complaint_after([count](Bytes& bytes) { bytes[kActionCountAt] = count; }).section, kNetworkSection) << int{count};
  EXPECT_TRUE(is(complaint_after([](Bytes& bytes) { bytes[kActivationAt + 3] = 0xFF; }), PolicyFault::kTooLarge, "NETW"));
  EXPECT_TRUE(is(complaint_after([](Bytes& bytes) { bytes[kListeningAt] = 1; }), PolicyFault::kUnknownListening, "OBSV"));
  EXPECT_TRUE(is(complaint_after([](Bytes& bytes) { bytes[kListeningAt + 1] = 1; }), PolicyFault::kUnknownListening, "OBSV"));
  const auto mean_of_121_s = [](Bytes& bytes) { bytes[kListeningAt] = 2, bytes[kListeningAt + 1] = 121; };
  EXPECT_TRUE(is(complaint_after(mean_of_121_s), PolicyFault::kUnknownListening, "OBSV"));
  const auto unknown_word = [](Bytes& bytes) { bytes[kListeningAt] = 3, bytes[kListeningAt + 1] = 1; };
  EXPECT_TRUE(is(complaint_after(unknown_word), PolicyFault::kUnknownListening, "OBSV"));
  EXPECT_TRUE(is(complaint_after([](Bytes& bytes) { bytes[kElementsAt] = 10; }), PolicyFault::kUnknownFeature, "OBSV"));
  EXPECT_TRUE(is(complaint_after([](Bytes& bytes) { bytes[kElementsAt - 1] = 65; }), PolicyFault::kBadShape, "OBSV"));
  EXPECT_TRUE(is(complaint_after([](Bytes& bytes) { bytes[kElementsAt - 1] = 3; }), PolicyFault::kBadSectionLength, "OBSV"));
  EXPECT_TRUE(
      is(complaint_after([](Bytes& bytes) { put(bytes, kElementsAt + 6, static_cast<float>(kNan)); }), PolicyFault::kNotFinite, "OBSV"));
  EXPECT_TRUE(is(complaint_after([](Bytes& bytes) { put(bytes, kStepLengthAt, 0.0); }), PolicyFault::kOutOfRange, "ACTN"));
  EXPECT_TRUE(is(complaint_after([](Bytes& bytes) { bytes[kDrawAt] = 3; }), PolicyFault::kUnknownDraw, "DRAW"));
  EXPECT_TRUE(is(complaint_after([](Bytes& bytes) { bytes[kFirstStepAt + 24] = 2; }), PolicyFault::kOutOfRange, "GOLD"));
  EXPECT_TRUE(is(complaint_after([](Bytes& bytes) { bytes[kFirstStepAt - 1] = 5; }), PolicyFault::kBadShape, "GOLD"));
  for (std::size_t i = 0; i < kParameters; ++i)
    EXPECT_TRUE(is(complaint_after([i](Bytes& bytes) { put(bytes, kWeightsAt + 4 * i, static_cast<float>(kNan)); }),
                   PolicyFault::kNotFinite, "NETW"))
        << i;
}

TEST(Parse, RefusesProvenanceThatIsTooLong) {
  const auto longer = [](Bytes& bytes) {
    put(bytes, kProvenanceSectionAt + 6, std::uint32_t{1025});
    insert(bytes, kProvenanceAt, Bytes(1001, 'x'));
  };
  EXPECT_TRUE(is(complaint_after(longer), PolicyFault::kBadShape, "PROV"));
}

}  // namespace
}  // namespace earshot::policy
