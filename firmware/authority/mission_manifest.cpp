#include "firmware/authority/mission_manifest.hpp"

#include <algorithm>
#include <string_view>

namespace earshot::authority {

std::array<std::uint8_t, kManifestBytes> signed_bytes(const MissionManifest& manifest) {
  constexpr std::string_view kDomain = "EARSHOT MISSION1";
  std::array<std::uint8_t, kManifestBytes> bytes{};
  auto at = std::copy(kDomain.begin(), kDomain.end(), bytes.begin());
  for (unsigned i = 0; i < 8; ++i) *at++ = static_cast<std::uint8_t>(manifest.counter >> (8U * i));
  at = std::copy(manifest.mission.begin(), manifest.mission.end(), at);
  std::copy(manifest.policy.begin(), manifest.policy.end(), at);
  return bytes;
}

ManifestVerdict judge_mission(const SignedManifest& signed_manifest, std::span<const Ed25519Key> trusted, bool is_signed,
                              const Sha256& mission) {
  if (std::find(trusted.begin(), trusted.end(), signed_manifest.key) == trusted.end()) return ManifestVerdict::kForeignKey;
  if (!is_signed) return ManifestVerdict::kFalseSignature;
  return signed_manifest.manifest.mission == mission ? ManifestVerdict::kAccepted : ManifestVerdict::kOtherMission;
}

ManifestVerdict judge_flight(const MissionManifest& manifest, const Sha256& policy, const MissionManifest& flown_last) {
  if (manifest.policy != policy) return ManifestVerdict::kOtherPolicy;
  if (manifest.counter == 0 || manifest.counter < flown_last.counter) return ManifestVerdict::kRolledBack;
  if (manifest.counter > flown_last.counter && manifest.counter - flown_last.counter > kMostCounterStep)
    return ManifestVerdict::kTooFarAhead;
  const bool is_later = manifest.counter > flown_last.counter;
  return is_later || manifest == flown_last ? ManifestVerdict::kAccepted : ManifestVerdict::kCounterInUse;
}

}  // namespace earshot::authority
