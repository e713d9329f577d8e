#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "firmware/config/capacities.hpp"
#include "firmware/config/mission.hpp"
#include "firmware/core/fixed_vector.hpp"
#include "firmware/core/geometry.hpp"
#include "firmware/core/status.hpp"
#include "firmware/policy/action_draw.hpp"
#include "firmware/policy/network.hpp"
#include "firmware/policy/observation.hpp"

namespace earshot::policy {

/// One observation and the logits it must give, bit for bit, on whatever machine the policy is loaded.
struct GoldenPair {
  std::array<float, config::kMaxObservation> observation{};
  std::array<float, config::kMaxActions> logits{};
};

/// Everything a `.policy` file holds but its checksum and signature.
struct FrozenPolicy {
  ObservationModel observation;  ///< the belief's actions, step_length, area_size, detection_threshold are those below
  FixedVector<UnitNorthEast, config::kMaxActions> actions;  ///< direction of each action; the table saves the vehicle sine and cosine
  Meters step_length;                                       ///< l the policy was trained with
  NorthEast area_size;                                      ///< of the area it was trained in, both > 0
  Decibels detection_threshold;                             ///< DT it was trained with
  ActionDraw draw = ActionDraw::kArgmax;
  Network network;
  std::array<GoldenPair, config::kGoldenPairs> golden{};
  FixedVector<char, config::kMaxProvenance> provenance;  ///< UTF-8 "key = value" lines: training command, commit, environment hash
};

/// What is wrong with the bytes of a policy, for the message a person reads; the Status says what to do.
enum class PolicyFault : std::uint8_t {
  kNone,
  kTooShort,        ///< shorter than its header or its own length field says
  kBadMagic,        ///< not a .policy file
  kUnknownVersion,  ///< of another format than kFormatVersion, older or later
  kBadChecksum,     ///< CRC-32 does not match
  kBadShape,        ///< a size is zero, over its capacity, or sizes contradict each other
  kUnknownActivation,
  kUnknownFeature,
  kUnknownDraw,
  kNotFinite,       ///< a weight, scale, direction, length or threshold is NaN, infinite, or no such thing (a direction not of length one)
  kGoldenMismatch,  ///< the network does not give the golden logits on this machine
};

/// What a mission asks of a policy that was trained for something else.
enum class Misfit : std::uint8_t { kNone, kStepLength, kAreaSize, kDetectionThreshold, kListening };

/// Corners far from the origin are rounded, and their difference with them; a vehicle does not notice.
inline constexpr Meters kAreaSizeTolerance{0.001};

/// The first of the mission's numbers that `policy` was not trained with. Where the area lies does not matter, only its size.
[[nodiscard]] Misfit misfit(const FrozenPolicy& policy, const config::Mission& mission);

inline constexpr std::uint32_t kFormatVersion = 3;
inline constexpr std::size_t kSignatureSize = 64;  ///< Ed25519, over every byte before it; the shell checks it, the core does not
inline constexpr std::size_t kPublicKeySize = 32;

/// Size of the largest serialised policy, bytes.
[[nodiscard]] std::size_t max_serialised_size();

/// Reads the bytes of a `.policy` file into `policy` and re-checks its golden pairs. On failure `policy` is unspecified.
/// Layout (little-endian): see README.md of this folder. The bytes end with public key, CRC-32, signature.
[[nodiscard]] Status parse(std::span<const std::uint8_t> bytes, FrozenPolicy& policy, PolicyFault& fault);

/// Writes `policy` as the bytes of a `.policy` file, golden pairs recomputed, CRC-32 in place, signature bytes zero (policy/freeze signs).
/// @return number of bytes written; kFull if `bytes` is too small; kUnsupported for a listening window, for which version 3 has no place;
/// kOutOfRange for a policy that parse() would refuse.
[[nodiscard]] Result<std::size_t> serialise(const FrozenPolicy& policy, std::span<const std::uint8_t, kPublicKeySize> public_key,
                                            std::span<std::uint8_t> bytes);

}  // namespace earshot::policy
