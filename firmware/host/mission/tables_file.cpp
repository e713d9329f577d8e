#include "firmware/host/mission/tables_file.hpp"

#include <iomanip>
#include <sstream>
#include <utility>

#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/file/shipped.hpp"
#include "firmware/host/policy/tables_bytes.hpp"
#include "firmware/host/text/numbers.hpp"
#include "firmware/host/trust/signed_bytes.hpp"

namespace earshot::host {
namespace {

using Bytes = std::vector<std::uint8_t>;

std::string words(double value) {
  return significant(value, 10);
}

/// "is of a vehicle at 300 m (270 to 330 m): not of one at 200 m"
std::string complaint(const char* what, double tables, double tolerance, double mission, const std::string& unit) {
  return std::string(what) + words(tables) + unit + " (" + words((1.0 - tolerance) * tables) + " to " + words((1.0 + tolerance) * tables) +
         unit + "): the mission's is " + words(mission) + unit;
}

std::string complaint_about(const policy::OceanTables& tables, const policy::SearchedSound& sound) {
  switch (policy::coverage(tables, sound)) {
    case policy::Coverage::kCovered:
      break;
    case policy::Coverage::kAnotherDepth:
      return complaint("is of a vehicle's depth of ", tables.receiver_depth.value, policy::kDepthTolerance, sound.vehicle_depth.value,
                       " m");
    case policy::Coverage::kAnotherFrequency:
      return complaint("is of a frequency of ", tables.frequency.value, policy::kFrequencyTolerance, sound.frequency.value, " Hz");
    case policy::Coverage::kOutOfReach:
      return "extends to " + words(policy::reach(tables).value) + " m, but in the mission's area a source may be " +
             words(sound.furthest.value) + " m from the vehicle";
  }
  return {};
}

}  // namespace

SignedTables signed_tables_from(Bytes bytes, const std::filesystem::path& path, const TrustedKey& trusted) {
  // As with policies, the file is taken apart before its signature is checked: "damaged" says more than "not signed".
  std::unique_ptr<policy::OceanTables> parsed = tables_from(bytes, path);
  require_signed_by(bytes, path, trusted);
  return {.tables = std::move(parsed), .bytes = std::move(bytes), .signer = trusted.file};
}

SignedTables signed_tables_from(Bytes bytes, const std::filesystem::path& path, const std::vector<TrustedKey>& trusted,
                                const std::string& trusted_by) {
  std::unique_ptr<policy::OceanTables> parsed = tables_from(bytes, path);
  std::filesystem::path signer = signer_of(bytes, path, trusted, trusted_by);
  return {.tables = std::move(parsed), .bytes = std::move(bytes), .signer = std::move(signer)};
}

SignedTables load_tables(const std::filesystem::path& path, const std::filesystem::path& public_key) {
  const TrustedKey trusted = load_public_key(public_key);
  return signed_tables_from(read_tables_bytes(path), path, trusted);
}

void require_coverage(const policy::OceanTables& tables, const std::filesystem::path& path, const policy::SearchedSound& sound) {
  const std::string what = complaint_about(tables, sound);
  if (!what.empty()) throw BadInput(path.string() + ": " + what);
}

TablesFile tables_of(const std::filesystem::path& named, const policy::FrozenPolicy& policy, const config::Mission& mission,
                     const std::filesystem::path& mission_path) {
  if (!policy::needs_belief(policy.observation.spec)) return {.path = {}, .bytes = {}, .tables = std::make_unique<policy::OceanTables>()};
  const std::filesystem::path tables = named.empty() ? shipped("policy/tables/shipped") : named;
  return tables_for(std::vector{tables}, policy::searched_sound(mission), tables.string() + ": the mission " + mission_path.string());
}

}  // namespace earshot::host
