#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include "firmware/authority/mission_manifest.hpp"
#include "firmware/host/mission/mission_file.hpp"
#include "firmware/host/mission/policy_file.hpp"
#include "firmware/host/mission/tables_file.hpp"
#include "firmware/host/trust/mission_counter.hpp"
#include "firmware/host/trust/vehicle_file.hpp"

namespace earshot::host {

/// All that a mission searches with.
struct SignedSearch {
  SignedPolicy policy;
  std::filesystem::path tables_file;  ///< empty: the policy needs no ocean tables, and `tables` has none and no bytes
  SignedTables tables;
};

/// What a mission's signature says of them: SHA-256 over the bytes of the policy and, behind these, of its tables.
[[nodiscard]] authority::Sha256 digest_of(std::span<const std::uint8_t> policy, std::span<const std::uint8_t> tables);

/// What becomes of a vehicle's counter.
enum class Counting : std::uint8_t {
  kRecorded,  ///< it flies: the counter's folder is locked, and record_flight() writes it
  kOnlyRead,  ///< a simulation
  kVerified,  ///< a checklist: it is only read, but must be one that kRecorded could write
  kLeftOut,   ///< where the vehicle's counter is not
};

/// Reads what is flown, and refuses what may not be: by the configuration of the vehicle, whose keys and counter no mission can name. Where
/// there is none, a mission is anybody's, and names itself the key that its policy is judged by.
///
/// In this order: load_mission(), load_search(), and, just before the first turn, record_flight().
/// Oracle: MissionVerifier.*
class MissionVerifier {
 public:
  MissionVerifier() = default;
  MissionVerifier(VehicleFile vehicle, Counting counting);

  /// No byte of a mission is read as TOML before its signature holds.
  /// @throws BadInput: no signature, not of a trusted key, not of these bytes; or as host::load_mission()
  [[nodiscard]] MissionFile load_mission(const std::filesystem::path& path);
  /// @throws BadInput: not signed by who is trusted, not the policy and tables that the mission was signed with, tables that do not cover
  /// the mission, or an older mission than was flown
  [[nodiscard]] SignedSearch load_search(const MissionFile& file);
  /// @throws BadInput when the disk does not take it: nothing may be flown then
  void record_flight();

  [[nodiscard]] bool requires_signed_mission() const { return vehicle_ && vehicle_->requires_signed_mission; }
  [[nodiscard]] bool has_vehicle() const { return vehicle_.has_value(); }

  /// What load_mission() and load_search() have found; nothing where missions need no signature.
  [[nodiscard]] const std::optional<authority::MissionManifest>& manifest() const { return manifest_; }
  [[nodiscard]] const std::filesystem::path& mission_signer() const { return mission_signer_; }
  [[nodiscard]] const authority::MissionManifest& flown_last() const { return flown_last_; }

 private:
  void verify_signature(const std::string& text);
  [[nodiscard]] SignedPolicy load_policy(const MissionFile& file) const;
  void load_tables(const MissionFile& file, SignedSearch& search) const;
  void verify_counter(const SignedSearch& search, const std::filesystem::path& policy_path);
  /// How a counter so high is told the vehicle to be meant, after "Sign with a lower counter"; empty: it is told in no way.
  [[nodiscard]] std::string raised_before(std::uint64_t counter) const;
  [[nodiscard]] VehicleTrust trust() const;
  [[nodiscard]] std::string setting(const char* key) const;

  std::optional<VehicleFile> vehicle_;
  Counting counting_ = Counting::kOnlyRead;
  std::optional<MissionCounter> counter_;
  std::filesystem::path mission_;
  std::optional<authority::MissionManifest> manifest_;
  std::filesystem::path mission_signer_;
  authority::MissionManifest flown_last_;
};

}  // namespace earshot::host
