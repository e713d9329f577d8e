#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "firmware/core/crc32.hpp"
#include "firmware/policy/format/policy_format.hpp"
#include "tests/firmware/policy/made_up_policy.hpp"

namespace earshot::policy {

using Bytes = std::vector<std::uint8_t>;

inline constexpr std::array<std::uint8_t, kPublicKeySize> kPublicKey = {1, 2, 3};

// Where things lie in the bytes of small_policy(), added up by hand from README.md.
inline constexpr std::size_t kVersionAt = 8;
inline constexpr std::size_t kLengthAt = 12;
inline constexpr std::size_t kNetworkAt = 16;  // each section's tag; its version lies 4, its length 6, its content 10 bytes further
inline constexpr std::size_t kActivationAt = 26;
inline constexpr std::size_t kActionCountAt = 32;
inline constexpr std::size_t kWeightsAt = 33;
inline constexpr std::size_t kParameters = 3 * 5 + 6 * 3 + 4 * 4;
inline constexpr std::size_t kObservationAt = 229;
inline constexpr std::size_t kAreaNorthAt = 239;
inline constexpr std::size_t kAreaEastAt = 247;
inline constexpr std::size_t kThresholdAt = 255;
inline constexpr std::size_t kListeningAt = 263;
inline constexpr std::size_t kElementsAt = 267;
inline constexpr std::size_t kActionsAt = 287;
inline constexpr std::size_t kStepLengthAt = 297;
inline constexpr std::size_t kDirectionsAt = 306;
inline constexpr std::size_t kDrawSectionAt = 370;
inline constexpr std::size_t kDrawAt = 380;
inline constexpr std::size_t kBeliefAt = 381;
inline constexpr std::size_t kProvenanceSectionAt = 391;
inline constexpr std::size_t kProvenanceAt = 401;
inline constexpr std::size_t kGoldenSectionAt = 425;
inline constexpr std::size_t kFirstStepAt = 437;
inline constexpr std::size_t kPublicKeyAt = 1649;
inline constexpr std::size_t kChecksumAt = 1681;
inline constexpr std::size_t kSizeInAll = 1749;

inline Bytes bytes_of(const FrozenPolicy& policy) {
  Bytes bytes(max_serialised_size());
  const Result<std::size_t> size = serialise(policy, kPublicKey, bytes);
  EXPECT_TRUE(size.ok());
  bytes.resize(size.ok() ? size.value() : 0);
  return bytes;
}

template <class Value>
void put(Bytes& bytes, std::size_t at, Value value) {
  const auto raw = std::bit_cast<std::array<std::uint8_t, sizeof(Value)>>(value);  // the test runs on a little-endian machine
  std::copy(raw.begin(), raw.end(), bytes.begin() + static_cast<std::ptrdiff_t>(at));
}

template <class Value>
Value value_at(const Bytes& bytes, std::size_t at) {
  std::array<std::uint8_t, sizeof(Value)> raw{};
  std::copy_n(bytes.begin() + static_cast<std::ptrdiff_t>(at), raw.size(), raw.begin());
  return std::bit_cast<Value>(raw);
}

/// Writes the length and the checksum that belong to what now lies in the bytes.
inline void mend(Bytes& bytes) {
  put(bytes, kLengthAt, static_cast<std::uint32_t>(bytes.size()));
  const std::size_t at = bytes.size() - kSignatureSize - 4;
  put(bytes, at, crc32(std::span(bytes).first(at)));
}

inline PolicyComplaint complaint_about(std::span<const std::uint8_t> bytes) {
  const auto policy = std::make_unique<FrozenPolicy>();
  PolicyComplaint complaint;
  const Status status = parse(bytes, *policy, complaint);
  EXPECT_EQ(status, status_of(complaint.fault));
  return complaint;
}

/// What parse() says of small_policy() after `damage`, length and checksum mended so that only the damage itself can be found.
template <class Damage>
PolicyComplaint complaint_after(Damage damage) {
  Bytes bytes = bytes_of(*small_policy());
  damage(bytes);
  mend(bytes);
  return complaint_about(bytes);
}

}  // namespace earshot::policy
