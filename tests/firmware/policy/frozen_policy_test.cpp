#include "firmware/policy/frozen_policy.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <string_view>
#include <tuple>
#include <vector>

#include "firmware/core/crc32.hpp"
#include "firmware/core/random.hpp"

namespace earshot::policy {
namespace {

constexpr std::array<std::uint8_t, kPublicKeySize> kPublicKey = {1, 2, 3};

// Where things lie, written down from README.md.
constexpr std::size_t kVersionAt = 8;
constexpr std::size_t kLengthAt = 12;
constexpr std::size_t kActivationAt = 16;
constexpr std::size_t kDrawAt = 17;
constexpr std::size_t kActionCountAt = 19;
constexpr std::size_t kStepLengthAt = 24;
constexpr std::size_t kAreaNorthAt = 32;
constexpr std::size_t kAreaEastAt = 40;
constexpr std::size_t kThresholdAt = 48;
constexpr std::size_t kElementsAt = 64;
constexpr std::size_t kDirectionsAt = kElementsAt + 2 * 12;
constexpr std::size_t kWeightsAt = kDirectionsAt + 4 * 16;
constexpr std::size_t kParameters = 3 * 5 + 6 * 3 + 4 * 4;
constexpr std::size_t kGoldenAt = kWeightsAt + 4 * kParameters;
constexpr std::size_t kProvenanceAt = kGoldenAt + 4 * 8 * (2 + 4);
constexpr std::string_view kProvenance = "command = earshot train\n";
constexpr std::size_t kPublicKeyAt = kProvenanceAt + kProvenance.size();
constexpr std::size_t kChecksumAt = kPublicKeyAt + 32;
constexpr std::size_t kLength = kChecksumAt + 4 + 64;

/// A 2-5-3-4 policy with weights from a generator.
std::unique_ptr<FrozenPolicy> small_policy() {
  auto policy = std::make_unique<FrozenPolicy>();
  policy->observation.spec = simple_state({.north = Meters{25000}, .east = Meters{25000}});
  for (const UnitNorthEast& direction : {UnitNorthEast{1, 0}, UnitNorthEast{0, 1}, UnitNorthEast{-1, 0}, UnitNorthEast{0.6, -0.8}}) {
    EXPECT_EQ(policy->actions.push_back(direction), Status::kOk);
  }
  policy->step_length = Meters{1000};
  policy->area_size = {.north = Meters{25000}, .east = Meters{26000}};
  policy->detection_threshold = Decibels{-3.5};
  policy->draw = ActionDraw::kSampled;
  policy->network.observation_size = 2;
  policy->network.hidden_sizes = {5, 3};
  policy->network.action_count = 4;
  Pcg32 random(21);
  const auto fill = [&random](auto& layer, std::size_t outputs, std::size_t inputs) {
    for (std::size_t i = 0; i < outputs * inputs; ++i) layer.weight(i / inputs, i % inputs) = random.uniform_float() - 0.5F;
    for (std::size_t i = 0; i < outputs; ++i) layer.bias[i] = random.uniform_float() - 0.5F;
  };
  fill(policy->network.first, 5, 2);
  fill(policy->network.second, 3, 5);
  fill(policy->network.output, 4, 3);
  for (const char character : kProvenance) EXPECT_EQ(policy->provenance.push_back(character), Status::kOk);
  return policy;
}

std::vector<std::uint8_t> bytes_of(const FrozenPolicy& policy) {
  std::vector<std::uint8_t> bytes(max_serialised_size());
  const Result<std::size_t> size = serialise(policy, kPublicKey, bytes);
  EXPECT_TRUE(size.ok());
  bytes.resize(size.ok() ? size.value() : 0);
  return bytes;
}

void mend_checksum(std::vector<std::uint8_t>& bytes) {
  const std::size_t at = bytes.size() - kSignatureSize - 4;
  const std::uint32_t crc = crc32(std::span(bytes).first(at));
  for (unsigned i = 0; i < 4; ++i) bytes[at + i] = static_cast<std::uint8_t>(crc >> (8U * i));
}

void put_float(std::vector<std::uint8_t>& bytes, std::size_t at, float value) {
  const auto raw = std::bit_cast<std::array<std::uint8_t, 4>>(value);  // the test runs on a little-endian machine
  std::copy(raw.begin(), raw.end(), bytes.begin() + static_cast<std::ptrdiff_t>(at));
}

void put_double(std::vector<std::uint8_t>& bytes, std::size_t at, double value) {
  const auto raw = std::bit_cast<std::array<std::uint8_t, 8>>(value);
  std::copy(raw.begin(), raw.end(), bytes.begin() + static_cast<std::ptrdiff_t>(at));
}

double double_at(const std::vector<std::uint8_t>& bytes, std::size_t at) {
  std::array<std::uint8_t, 8> raw{};
  std::copy_n(bytes.begin() + static_cast<std::ptrdiff_t>(at), raw.size(), raw.begin());
  return std::bit_cast<double>(raw);
}

struct Parsed {
  Status status;
  PolicyFault fault;
};

Parsed parsed(std::span<const std::uint8_t> bytes) {
  const auto policy = std::make_unique<FrozenPolicy>();
  Parsed result{};
  result.status = parse(bytes, *policy, result.fault);
  return result;
}

/// What parse() says of a good policy after `damage`, its checksum mended so that only the damage itself can be found.
Parsed parsed_after(const std::function<void(std::vector<std::uint8_t>&)>& damage) {
  std::vector<std::uint8_t> bytes = bytes_of(*small_policy());
  damage(bytes);
  mend_checksum(bytes);
  return parsed(bytes);
}

TEST(FrozenPolicy, LiesInItsBytesAsTheReadmeSays) {
  const std::vector<std::uint8_t> bytes = bytes_of(*small_policy());
  ASSERT_EQ(bytes.size(), kLength);
  EXPECT_EQ(std::string_view(reinterpret_cast<const char*>(bytes.data()), 8), "EARSHOTP");
  EXPECT_EQ(bytes[kVersionAt], 3);
  EXPECT_EQ(bytes[kLengthAt] + 256U * bytes[kLengthAt + 1], kLength);
  EXPECT_EQ(bytes[kActionCountAt], 4);
  EXPECT_EQ(double_at(bytes, kStepLengthAt), 1000.0);
  EXPECT_EQ(double_at(bytes, kAreaNorthAt), 25000.0);
  EXPECT_EQ(double_at(bytes, kAreaEastAt), 26000.0);
  EXPECT_EQ(double_at(bytes, kThresholdAt), -3.5);
  EXPECT_EQ(std::string_view(reinterpret_cast<const char*>(bytes.data()) + kProvenanceAt, kProvenance.size()), kProvenance);
  EXPECT_EQ(bytes[kPublicKeyAt], 1);
}

TEST(FrozenPolicy, ComesBackFromItsBytesAsItWas) {
  const auto before = small_policy();
  const std::vector<std::uint8_t> bytes = bytes_of(*before);
  const auto after = std::make_unique<FrozenPolicy>();
  PolicyFault fault{};
  ASSERT_EQ(parse(bytes, *after, fault), Status::kOk);
  EXPECT_EQ(fault, PolicyFault::kNone);
  EXPECT_TRUE(std::ranges::equal(after->observation.spec, before->observation.spec));
  EXPECT_TRUE(std::ranges::equal(after->actions, before->actions));
  EXPECT_TRUE(std::ranges::equal(after->provenance, before->provenance));
  EXPECT_EQ(after->step_length, before->step_length);
  EXPECT_EQ(after->area_size, before->area_size);
  EXPECT_EQ(after->detection_threshold, before->detection_threshold);
  EXPECT_EQ(after->draw, before->draw);
  EXPECT_EQ(after->network.hidden_sizes, before->network.hidden_sizes);
  EXPECT_EQ(after->network.first.packed, before->network.first.packed);
  EXPECT_EQ(after->network.second.bias, before->network.second.bias);
  EXPECT_EQ(after->network.output.packed, before->network.output.packed);
  EXPECT_EQ(bytes_of(*after), bytes);
}

TEST(FrozenPolicy, MayReplaceALargerOneInPlace) {
  const auto policy = std::make_unique<FrozenPolicy>();
  policy->observation.spec = memory_state(21, Meters{1000}, Decibels{10}).value();
  policy->network.observation_size = 63;
  PolicyFault fault{};
  const std::vector<std::uint8_t> bytes = bytes_of(*small_policy());
  ASSERT_EQ(parse(bytes, *policy, fault), Status::kOk);
  EXPECT_EQ(policy->observation.spec.size(), 2U);
  EXPECT_EQ(bytes_of(*policy), bytes);
}

TEST(FrozenPolicy, OfTheLargestSizesFillsTheLargestSerialisedSize) {
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
  const std::vector<std::uint8_t> bytes = bytes_of(*policy);
  EXPECT_EQ(bytes.size(), max_serialised_size());
  EXPECT_EQ(parsed(bytes).status, Status::kOk);
}

/// small_policy() that sees a belief of two hypotheses and five ranges.
std::unique_ptr<FrozenPolicy> believing_policy() {
  auto policy = small_policy();
  BeliefModel& belief = policy->observation.belief;
  belief.actions = policy->actions;
  belief.step_length = policy->step_length;
  belief.area_size = policy->area_size;
  belief.detection_threshold = policy->detection_threshold;
  belief.border_width = Meters{700};
  belief.cells_north = 49;
  belief.cells_east = 51;
  belief.outlier_share = 0.125F;
  belief.silence_share = 0.25F;
  belief.forgotten_share = 0.0625F;
  belief.range_step = Meters{150};
  EXPECT_EQ(belief.hypotheses.push_back({.level_offset_db = -1.0F, .spread_db = 2.0F, .prior = 3.0F}), Status::kOk);
  EXPECT_EQ(belief.hypotheses.push_back({.level_offset_db = 4.0F, .spread_db = 5.0F, .prior = 6.0F}), Status::kOk);
  for (int i = 0; i < 5; ++i) EXPECT_EQ(belief.snr_db.push_back(static_cast<float>(i) - 1.5F), Status::kOk);
  policy->observation.spec.clear();
  EXPECT_EQ(policy->observation.spec.push_back({.feature = Feature::kPreference, .age = 3}), Status::kOk);
  EXPECT_EQ(policy->observation.spec.push_back({.feature = Feature::kHypothesis, .age = 1}), Status::kOk);
  return policy;
}

TEST(FrozenPolicy, CarriesItsBelief) {
  const auto before = believing_policy();
  const std::vector<std::uint8_t> bytes = bytes_of(*before);
  EXPECT_EQ(bytes.size(), kLength + 36 + 2 * 12 + 5 * 4);
  const auto after = std::make_unique<FrozenPolicy>();
  PolicyFault fault{};
  ASSERT_EQ(parse(bytes, *after, fault), Status::kOk);
  const BeliefModel& a = after->observation.belief;
  const BeliefModel& b = before->observation.belief;
  EXPECT_TRUE(std::ranges::equal(after->observation.spec, before->observation.spec));
  EXPECT_TRUE(std::ranges::equal(a.hypotheses, b.hypotheses));
  EXPECT_TRUE(std::ranges::equal(a.snr_db, b.snr_db));
  EXPECT_TRUE(std::ranges::equal(a.actions, b.actions));
  EXPECT_EQ(std::tuple(a.cells_north, a.cells_east, a.border_width, a.range_step), std::tuple(49, 51, Meters{700}, Meters{150}));
  EXPECT_EQ(std::tuple(a.outlier_share, a.silence_share, a.forgotten_share), std::tuple(0.125F, 0.25F, 0.0625F));
  EXPECT_EQ(std::tuple(a.area_size, a.step_length, a.detection_threshold), std::tuple(b.area_size, b.step_length, b.detection_threshold));
  EXPECT_EQ(bytes_of(*after), bytes);
}

TEST(FrozenPolicy, WithABeliefThatCannotBeIsRefused) {
  std::vector<std::uint8_t> bytes(max_serialised_size());
  const auto refused = [&bytes](const std::function<void(BeliefModel&)>& damage) {
    const auto policy = believing_policy();
    damage(policy->observation.belief);
    return serialise(*policy, kPublicKey, bytes).status() == Status::kOutOfRange;
  };
  EXPECT_TRUE(refused([](BeliefModel& m) { m.cells_north = 0; }));
  EXPECT_TRUE(refused([](BeliefModel& m) { m.cells_north = 50; }));  // 50 x 51 are more than 2500
  EXPECT_TRUE(refused([](BeliefModel& m) { m.hypotheses.clear(); }));
  EXPECT_TRUE(refused([](BeliefModel& m) { m.snr_db.clear(); }));
  EXPECT_TRUE(refused([](BeliefModel& m) { m.snr_db[2] = std::numeric_limits<float>::quiet_NaN(); }));
  EXPECT_TRUE(refused([](BeliefModel& m) { m.hypotheses[0].spread_db = 0.0F; }));
  EXPECT_TRUE(refused([](BeliefModel& m) { m.hypotheses[1].prior = -1.0F; }));
  EXPECT_TRUE(refused([](BeliefModel& m) { m.outlier_share = 1.5F; }));
  EXPECT_TRUE(refused([](BeliefModel& m) { m.silence_share = std::numeric_limits<float>::quiet_NaN(); }));
  EXPECT_TRUE(refused([](BeliefModel& m) { m.forgotten_share = 0.6F; }));
  EXPECT_TRUE(refused([](BeliefModel& m) { m.range_step = Meters{0}; }));
  EXPECT_TRUE(refused([](BeliefModel& m) { m.step_length = Meters{999}; }));  // of another search than the policy
  EXPECT_FALSE(refused([](BeliefModel&) {}));
}

TEST(FrozenPolicy, WithABeliefOutOfRangeIsRefusedByParse) {
  constexpr std::size_t kBeliefAt = kElementsAt + 2 * 12 + 4 * 16;  // elements, directions
  constexpr std::size_t kBorderAt = kBeliefAt + 4;
  constexpr std::size_t kRangeStepAt = kBorderAt + 8;
  constexpr std::size_t kOffsetAt = kBeliefAt + 36;  // of the first hypothesis
  constexpr std::size_t kSpreadAt = kOffsetAt + 4;
  constexpr std::size_t kPriorAt = kOffsetAt + 8;
  constexpr std::size_t kSnrAt = kOffsetAt + 2 * 12;
  const std::vector<std::uint8_t> whole = bytes_of(*believing_policy());
  const auto fault = [&whole](std::size_t at, auto value) {
    std::vector<std::uint8_t> bytes = whole;
    if constexpr (sizeof(value) == 4)
      put_float(bytes, at, value);
    else
      put_double(bytes, at, value);
    mend_checksum(bytes);
    return parsed(bytes).fault;
  };
  EXPECT_EQ(fault(kSpreadAt, 1e-39F), PolicyFault::kNotFinite);  // its inverse is infinite
  EXPECT_EQ(fault(kSpreadAt, 0.04F), PolicyFault::kNotFinite);
  EXPECT_EQ(fault(kSpreadAt, 101.0F), PolicyFault::kNotFinite);
  EXPECT_EQ(fault(kOffsetAt, -1'001.0F), PolicyFault::kNotFinite);
  EXPECT_EQ(fault(kPriorAt, 1e-7F), PolicyFault::kNotFinite);
  EXPECT_EQ(fault(kPriorAt, 3e38F), PolicyFault::kNotFinite);
  EXPECT_EQ(fault(kSnrAt, 3e38F), PolicyFault::kNotFinite);
  EXPECT_EQ(fault(kRangeStepAt, 0.5), PolicyFault::kNotFinite);
  EXPECT_EQ(fault(kRangeStepAt, 10'001.0), PolicyFault::kNotFinite);
  EXPECT_EQ(fault(kBorderAt, 1.1e6), PolicyFault::kNotFinite);
  EXPECT_EQ(fault(kStepLengthAt, 1.1e6), PolicyFault::kNotFinite);
  EXPECT_EQ(fault(kAreaNorthAt, 1.1e7), PolicyFault::kNotFinite);
  EXPECT_EQ(fault(kAreaEastAt, 1.1e7), PolicyFault::kNotFinite);
  EXPECT_EQ(fault(kAreaEastAt, 1e-300), PolicyFault::kNotFinite);  // no area as a float
  EXPECT_EQ(fault(kSpreadAt, 2.0F), PolicyFault::kNone) << "as it was";
}

TEST(FrozenPolicy, CutShortAnywhereIsTooShort) {
  const std::vector<std::uint8_t> bytes = bytes_of(*small_policy());
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    const std::vector<std::uint8_t> cut(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size));
    const Parsed result = parsed(cut);
    EXPECT_EQ(result.status, Status::kMalformed) << size;
    EXPECT_EQ(result.fault, PolicyFault::kTooShort) << size;
  }
}

TEST(FrozenPolicy, WithBytesBehindItIsRefused) {
  std::vector<std::uint8_t> bytes = bytes_of(*small_policy());
  bytes.push_back(0);
  EXPECT_EQ(parsed(bytes).fault, PolicyFault::kBadShape);
}

TEST(FrozenPolicy, WithAnyBitFlippedBeforeItsSignatureIsRefused) {
  std::vector<std::uint8_t> bytes = bytes_of(*small_policy());
  for (std::size_t bit = 0; bit < 8 * (bytes.size() - kSignatureSize); ++bit) {
    const auto mask = static_cast<std::uint8_t>(1U << (bit % 8));
    bytes[bit / 8] ^= mask;
    EXPECT_NE(parsed(bytes).status, Status::kOk) << bit;
    bytes[bit / 8] ^= mask;
  }
}

TEST(FrozenPolicy, LeavesTheSignatureToTheShell) {
  std::vector<std::uint8_t> bytes = bytes_of(*small_policy());
  bytes.back() = 0xAA;
  EXPECT_EQ(parsed(bytes).status, Status::kOk);
}

TEST(FrozenPolicy, WithAWrongChecksumIsCorrupt) {
  std::vector<std::uint8_t> bytes = bytes_of(*small_policy());
  bytes[kChecksumAt] ^= 1U;
  EXPECT_EQ(parsed(bytes).status, Status::kCorrupt);
  EXPECT_EQ(parsed(bytes).fault, PolicyFault::kBadChecksum);
}

TEST(FrozenPolicy, NamesWhatIsWrongWithItsHeader) {
  EXPECT_EQ(parsed_after([](auto& bytes) { bytes[0] = 'e'; }).fault, PolicyFault::kBadMagic);
  EXPECT_EQ(parsed_after([](auto& bytes) { bytes[kVersionAt] = 2; }).fault, PolicyFault::kUnknownVersion);
  EXPECT_EQ(parsed_after([](auto& bytes) { bytes[kVersionAt] = 4; }).fault, PolicyFault::kUnknownVersion);
  EXPECT_EQ(parsed_after([](auto& bytes) { bytes[kActivationAt] = 0; }).fault, PolicyFault::kUnknownActivation);
  EXPECT_EQ(parsed_after([](auto& bytes) { bytes[kDrawAt] = 3; }).fault, PolicyFault::kUnknownDraw);
  EXPECT_EQ(parsed_after([](auto& bytes) { bytes[kActionCountAt] = 0; }).fault, PolicyFault::kBadShape);
  EXPECT_EQ(parsed_after([](auto& bytes) { bytes[kActionCountAt] = 33; }).fault, PolicyFault::kBadShape);
  EXPECT_EQ(parsed_after([](auto& bytes) { bytes[kActionCountAt] = 5; }).fault, PolicyFault::kBadShape);
  EXPECT_EQ(parsed_after([](auto& bytes) { put_double(bytes, kStepLengthAt, 0.0); }).fault, PolicyFault::kNotFinite);
  EXPECT_EQ(parsed_after([](auto& bytes) { bytes[kElementsAt] = 10; }).fault, PolicyFault::kUnknownFeature);
  EXPECT_EQ(parsed_after([](auto& bytes) { bytes[kElementsAt + 1] = config::kMaxRememberedSteps; }).fault, PolicyFault::kBadShape);
}

TEST(FrozenPolicy, WithANumberThatIsNoneIsRefused) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(parsed_after([](auto& bytes) { put_float(bytes, kElementsAt + 8, kNan); }).fault, PolicyFault::kNotFinite);
  EXPECT_EQ(parsed_after([](auto& bytes) { put_double(bytes, kDirectionsAt, 0.5); }).fault, PolicyFault::kNotFinite);
  EXPECT_EQ(parsed_after([](auto& bytes) { put_double(bytes, kAreaNorthAt, 0.0); }).fault, PolicyFault::kNotFinite);
  EXPECT_EQ(parsed_after([](auto& bytes) { put_double(bytes, kAreaEastAt, double{kNan}); }).fault, PolicyFault::kNotFinite);
  EXPECT_EQ(parsed_after([](auto& bytes) { put_double(bytes, kThresholdAt, double{kNan}); }).fault, PolicyFault::kNotFinite);
  for (std::size_t i = 0; i < kParameters; ++i) {
    const Parsed result = parsed_after([i](auto& bytes) { put_float(bytes, kWeightsAt + 4 * i, kNan); });
    EXPECT_EQ(result.status, Status::kOutOfRange) << i;
    EXPECT_EQ(result.fault, PolicyFault::kNotFinite) << i;
  }
}

TEST(FrozenPolicy, ThatDoesNotGiveItsGoldenLogitsIsCorrupt) {
  const Parsed result = parsed_after([](auto& bytes) { bytes[kGoldenAt + 2 * 4] ^= 1U; });
  EXPECT_EQ(result.status, Status::kCorrupt);
  EXPECT_EQ(result.fault, PolicyFault::kGoldenMismatch);
}

void survive_any_change_of(const std::vector<std::uint8_t>& good) {
  const auto policy = std::make_unique<FrozenPolicy>();
  Pcg32 random(31);
  for (int round = 0; round < 20000; ++round) {
    std::vector<std::uint8_t> bytes = good;
    const std::uint32_t changes = 1 + random.next() % 8;
    for (std::uint32_t i = 0; i < changes; ++i) {
      const bool in_header = (random.next() & 1U) != 0U;
      bytes[random.next() % (in_header ? kWeightsAt : bytes.size())] = static_cast<std::uint8_t>(random.next());
    }
    mend_checksum(bytes);
    PolicyFault fault{};
    const Status status = parse(bytes, *policy, fault);
    ASSERT_EQ(status == Status::kOk, fault == PolicyFault::kNone);
    if (status == Status::kOk) {
      ASSERT_EQ(bytes_of(*policy).size(), bytes.size());
    }
  }
}

TEST(FrozenPolicy, SurvivesAnyBytesWhatever) {
  survive_any_change_of(bytes_of(*small_policy()));
}

TEST(FrozenPolicy, SurvivesAnyBytesWhateverInItsBelief) {
  survive_any_change_of(bytes_of(*believing_policy()));
}

/// A mission that small_policy() was trained for, its corners where a sum of doubles rounds.
config::Mission fitting_mission() {
  config::Mission mission;
  mission.operating_area.south_west = {.north = Meters{-5000.1}, .east = Meters{1000.3}};
  mission.operating_area.north_east = {.north = Meters{19999.9}, .east = Meters{27000.3}};
  mission.step_length = Meters{1000};
  mission.detection_threshold = Decibels{-3.5};
  return mission;
}

TEST(Serialise, RefusesAListeningWindowForWhichTheFormatHasNoPlace) {
  const auto policy = small_policy();
  policy->observation.listening = {config::Listening::kLoudest, Duration::seconds(30)};
  std::vector<std::uint8_t> bytes(max_serialised_size());
  EXPECT_EQ(serialise(*policy, std::array<std::uint8_t, kPublicKeySize>{}, bytes).status(), Status::kUnsupported);
}

Misfit misfit_after(const std::function<void(config::Mission&)>& change) {
  config::Mission mission = fitting_mission();
  change(mission);
  return misfit(*small_policy(), mission);
}

TEST(FrozenPolicy, FitsAMissionWhereverItsAreaLies) {
  EXPECT_EQ(misfit(*small_policy(), fitting_mission()), Misfit::kNone);
}

TEST(FrozenPolicy, DoesNotFitAMissionOfAnotherStepAreaOrThreshold) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(misfit_after([](auto& mission) { mission.step_length = Meters{999}; }), Misfit::kStepLength);
  EXPECT_EQ(misfit_after([](auto& mission) { mission.operating_area.north_east.north += Meters{0.1}; }), Misfit::kAreaSize);
  EXPECT_EQ(misfit_after([](auto& mission) { mission.operating_area.north_east.east -= Meters{0.1}; }), Misfit::kAreaSize);
  EXPECT_EQ(misfit_after([](auto& mission) { mission.operating_area.south_west.east = Meters{kNan}; }), Misfit::kAreaSize);
  EXPECT_EQ(misfit_after([](auto& mission) { mission.detection_threshold = Decibels{-3.4}; }), Misfit::kDetectionThreshold);
  EXPECT_EQ(misfit_after([](auto& mission) { mission.listening = {config::Listening::kMean, Duration::seconds(15)}; }), Misfit::kListening);
}

TEST(Serialise, RefusesAPolicyThatParseWouldRefuse) {
  std::vector<std::uint8_t> bytes(max_serialised_size());
  const auto refused = [&bytes](const std::function<void(FrozenPolicy&)>& damage) {
    const auto policy = small_policy();
    damage(*policy);
    return serialise(*policy, kPublicKey, bytes).status();
  };
  EXPECT_EQ(refused([](FrozenPolicy& policy) { policy.network.observation_size = 3; }), Status::kOutOfRange);
  EXPECT_EQ(refused([](FrozenPolicy& policy) { policy.network.hidden_sizes[1] = 65; }), Status::kOutOfRange);
  EXPECT_EQ(refused([](FrozenPolicy& policy) { policy.actions.clear(); }), Status::kOutOfRange);
  EXPECT_EQ(refused([](FrozenPolicy& policy) { policy.network.second.bias[2] = std::numeric_limits<float>::infinity(); }),
            Status::kOutOfRange);
  EXPECT_EQ(refused([](FrozenPolicy& policy) { policy.step_length = Meters{-1}; }), Status::kOutOfRange);
  EXPECT_EQ(refused([](FrozenPolicy& policy) { policy.area_size.east = Meters{0}; }), Status::kOutOfRange);
  EXPECT_EQ(refused([](FrozenPolicy& policy) { policy.network.output.packed.fill(3e38F); }), Status::kOutOfRange);  // logits overflow
}

TEST(Serialise, SaysFullWhenOneByteIsMissing) {
  std::vector<std::uint8_t> bytes(kLength - 1);
  EXPECT_EQ(serialise(*small_policy(), kPublicKey, bytes).status(), Status::kFull);
}

}  // namespace
}  // namespace earshot::policy
