#include "firmware/host/mission/mission_verifier.hpp"

#include <algorithm>
#include <system_error>
#include <utility>
#include <vector>

#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/file/input_file.hpp"
#include "firmware/host/trust/mission_counter.hpp"
#include "firmware/host/trust/signature_file.hpp"

namespace earshot::host {
namespace {

using authority::ManifestVerdict;
using authority::SignedManifest;

/// @throws BadInput that says more than "no such file"
SignedManifest signature_beside(const std::filesystem::path& mission, const std::string& required_by) {
  const std::filesystem::path file = signature_file_of(mission);
  std::error_code error;
  if (std::filesystem::symlink_status(file, error).type() == std::filesystem::file_type::not_found)
    throw BadInput(mission.string() + ": is not signed, which " + required_by + " asks for: there is no " + file.string() +
                   "; earshot sign makes one");
  return read_signature(file);
}

std::vector<PublicKey> keys_of(const std::vector<TrustedKey>& trusted) {
  std::vector<PublicKey> keys;
  for (const TrustedKey& key : trusted) keys.push_back(key.key);
  return keys;
}

}  // namespace

authority::Sha256 digest_of(std::span<const std::uint8_t> policy, std::span<const std::uint8_t> tables) {
  std::vector<std::uint8_t> both(policy.begin(), policy.end());
  both.insert(both.end(), tables.begin(), tables.end());
  return sha256_of(std::span<const std::uint8_t>(both));
}

MissionVerifier::MissionVerifier(VehicleFile vehicle, Counting counting) : vehicle_(std::move(vehicle)), counting_(counting) {}

std::string MissionVerifier::setting(const char* key) const {
  return std::string("trust.") + key + " of " + vehicle_->path.string();
}

VehicleTrust MissionVerifier::trust() const {
  VehicleTrust trust{.stated_in = vehicle_->path.string(),
                     .command_key = std::nullopt,
                     .command_key_file = vehicle_->command_key_file.value_or(""),
                     .reads_own_command_key = !vehicle_->requires_signed_mission,
                     .vehicle_id = vehicle_->vehicle_id,
                     .accepts_old_marks = vehicle_->accepts_old_marks};
  if (vehicle_->command_key_file) trust.command_key = CommandKey(trust.command_key_file);
  return trust;
}

MissionFile MissionVerifier::load_mission(const std::filesystem::path& path) {
  mission_ = path;
  if (!vehicle_) return host::load_mission(path);
  const std::string text = read_text(path, kTomlFile);
  if (vehicle_->requires_signed_mission) verify_signature(text);
  return host::load_mission(path, text, trust());
}

void MissionVerifier::verify_signature(const std::string& text) {
  const SignedManifest found = signature_beside(mission_, setting("require_signed_mission"));
  const std::filesystem::path file = signature_file_of(mission_);
  const ManifestVerdict verdict =
      authority::judge_mission(found, keys_of(vehicle_->mission_keys), is_signed(found), sha256_of(std::string_view(text)));
  const auto signer = std::ranges::find(vehicle_->mission_keys, found.key, &TrustedKey::key);
  if (verdict == ManifestVerdict::kForeignKey)
    throw BadInput(file.string() + ": is of the key " + to_hex(found.key) + ", which is none of " + setting("mission_keys") + " (" +
                   files_of(vehicle_->mission_keys) + ")");
  if (verdict == ManifestVerdict::kFalseSignature)
    throw BadInput(file.string() + ": is forged or damaged: the holder of " + signer->file.string() + " did not sign its text");
  if (verdict == ManifestVerdict::kOtherMission)
    throw BadInput(mission_.string() + ": has been changed since " + signer->file.string() + " signed it (" + file.string() + ")");
  manifest_ = found.manifest;
  mission_signer_ = signer->file;
}

SignedSearch MissionVerifier::load_search(const MissionFile& file) {
  SignedSearch search{.policy = load_policy(file), .tables_file = {}, .tables = {}};
  load_tables(file, search);
  if (manifest_) verify_counter(search, file.policy);
  return search;
}

SignedPolicy MissionVerifier::load_policy(const MissionFile& file) const {
  if (!vehicle_) return host::load_policy(file.policy, file.public_key);
  return signed_policy_from(read_policy_bytes(file.policy), file.policy, vehicle_->policy_keys, setting("policy_keys"));
}

void MissionVerifier::load_tables(const MissionFile& file, SignedSearch& search) const {
  TablesFile chosen = tables_of(file.tables, *search.policy.policy, file.mission, mission_);
  search.tables_file = chosen.path;
  if (chosen.path.empty()) {
    search.tables.tables = std::move(chosen.tables);
  } else if (vehicle_) {
    search.tables = signed_tables_from(std::move(chosen.bytes), chosen.path, vehicle_->policy_keys, setting("policy_keys"));
  } else {
    search.tables = signed_tables_from(std::move(chosen.bytes), chosen.path, load_public_key(file.public_key));
  }
}

std::string MissionVerifier::raised_before(std::uint64_t counter) const {
  if (counter - 1 > static_cast<std::uint64_t>(kHighestSetCounter)) return {};
  return ", or, if it is meant, raise the counter on the vehicle: earshot verify --vehicle " + vehicle_->path.string() +
         " --raise-counter " + std::to_string(counter - 1);
}

void MissionVerifier::verify_counter(const SignedSearch& search, const std::filesystem::path& policy_path) {
  if (counting_ == Counting::kRecorded) counter_.emplace(vehicle_->counter_file);
  if (counter_) flown_last_ = counter_->flown_last();
  if (counting_ == Counting::kOnlyRead || counting_ == Counting::kVerified) flown_last_ = read_flown_last(vehicle_->counter_file);
  if (counting_ == Counting::kVerified) require_recordable(vehicle_->counter_file);
  const std::string counter = signature_file_of(mission_).string() + ": counter " + std::to_string(manifest_->counter);
  const std::string last = std::to_string(flown_last_.counter);
  const std::string flown = " (" + vehicle_->counter_file.string() + "); sign what is to be flown now with a greater counter";
  switch (authority::judge_flight(*manifest_, digest_of(search.policy.bytes, search.tables.bytes), flown_last_)) {
    case ManifestVerdict::kOtherPolicy:
      throw BadInput(policy_path.string() + ": with its ocean tables is not the policy that " + mission_.string() +
                     " was signed with: one of them has been changed, or is another");
    case ManifestVerdict::kRolledBack:
      throw BadInput(counter + " is rolled back: the vehicle has flown " + last + flown);
    case ManifestVerdict::kCounterInUse:
      throw BadInput(counter + " has been used, and not for this mission and policy" + flown);
    case ManifestVerdict::kTooFarAhead:
      throw BadInput(counter + " is more than " + std::to_string(authority::kMostCounterStep) + " above " + last +
                     ", which the vehicle has flown (" + vehicle_->counter_file.string() + "): a slip? Sign with a lower counter" +
                     raised_before(manifest_->counter));
    case ManifestVerdict::kAccepted:
    case ManifestVerdict::kForeignKey:
    case ManifestVerdict::kFalseSignature:
    case ManifestVerdict::kOtherMission:
      break;
  }
}

void MissionVerifier::record_flight() {
  if (counter_) counter_->record(*manifest_);
}

}  // namespace earshot::host
