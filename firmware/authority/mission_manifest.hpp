#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace earshot::authority {

/// A hash of bytes. Source: FIPS 180-4.
using Sha256 = std::array<std::uint8_t, 32>;
/// Source: RFC 8032.
using Ed25519Key = std::array<std::uint8_t, 32>;
using Ed25519Signature = std::array<std::uint8_t, 64>;

/// What whoever signs a mission vouches for. Plain data: read from a file on Linux, a constant on bare metal.
/// Source: RFC 9124, "Monotonic Sequence Number" and "Payload Digests" of a firmware manifest: the same, for missions.
struct MissionManifest {
  std::uint64_t counter = 0;  ///< rises from mission to mission; 0: no mission yet, which nobody can sign
  Sha256 mission{};           ///< of the mission's bytes
  Sha256 policy{};            ///< of those of the policy that it names, with its ocean tables' behind them
  friend bool operator==(const MissionManifest&, const MissionManifest&) = default;
};

inline constexpr std::size_t kManifestBytes = 16 + 8 + 32 + 32;

/// The bytes that are signed: "EARSHOT MISSION1", so that a signature of anything else is none of a mission; the counter, little-endian;
/// both hashes.
/// Oracle: MissionManifest.*
[[nodiscard]] std::array<std::uint8_t, kManifestBytes> signed_bytes(const MissionManifest& manifest);

struct SignedManifest {
  MissionManifest manifest;
  Ed25519Key key{};  ///< of who says to have signed it
  Ed25519Signature signature{};
};

enum class ManifestVerdict : std::uint8_t {
  kAccepted,
  kForeignKey,      ///< the vehicle does not trust who signed it
  kFalseSignature,  ///< it is not what the key's holder signed
  kOtherMission,    ///< the mission has been changed since
  kOtherPolicy,     ///< the policy, or its tables, have been changed since, or are others
  kRolledBack,      ///< a later mission has flown
  kCounterInUse,    ///< another mission with this counter has flown
  kTooFarAhead,     ///< its counter is more than kMostCounterStep above that of what flew last
};

/// One mission raises a vehicle's counter by so much at most: the highest number, of a slip or of a key in wrong hands, would else be the
/// last that the vehicle flies. It takes 2^31 missions to use all numbers up, and who counts by the seconds since 1970 may begin at 0.
inline constexpr std::uint64_t kMostCounterStep = std::uint64_t{1} << 32U;

/// Whether somebody who is trusted signed these bytes of a mission. They are worth reading only then, and only a reader knows the policy.
/// @param is_signed  whether `signed_manifest.signature` is of signed_bytes() by `signed_manifest.key` (Ed25519): the board finds that out,
///                   which has a library or a peripheral for it
[[nodiscard]] ManifestVerdict judge_mission(const SignedManifest& signed_manifest, std::span<const Ed25519Key> trusted, bool is_signed,
                                            const Sha256& mission);

/// Whether a mission whose manifest holds may be flown with this policy, after what flew last. The very same mission may be flown again,
/// because a vehicle that restarts is not to be stranded.
[[nodiscard]] ManifestVerdict judge_flight(const MissionManifest& manifest, const Sha256& policy, const MissionManifest& flown_last);

}  // namespace earshot::authority
