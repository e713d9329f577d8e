#include "firmware/host/mission/policy_file.hpp"

#include <cstdint>
#include <iomanip>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "firmware/host/file/input_file.hpp"
#include "firmware/host/listening/listening_words.hpp"
#include "firmware/host/policy/policy_bytes.hpp"
#include "firmware/host/text/numbers.hpp"
#include "firmware/host/toml/table_reader.hpp"
#include "firmware/host/trust/signed_bytes.hpp"
#include "firmware/policy/format/policy_format.hpp"

namespace earshot::host {
namespace {

using host::to_string;  // beside the two here
using Bytes = std::vector<std::uint8_t>;

std::string to_string(double value) {
  return significant(value, 10);
}

std::string to_string(NorthEast size) {
  return to_string(size.north.value) + " m north x " + to_string(size.east.value) + " m east";
}

/// "KEY = VALUE: must be VALUE" of the mission's number that does not fit; empty when all do.
std::string complaint_about(const policy::FrozenPolicy& policy, const config::Mission& mission) {
  const Rectangle& area = mission.operating_area;
  switch (policy::mismatch(policy, mission)) {
    case policy::Mismatch::kNone:
      break;
    case policy::Mismatch::kStepLength:
      return "search.step_length_m = " + to_string(mission.step_length.value) + ": must be " + to_string(policy.step_length.value);
    case policy::Mismatch::kAreaSize:
      return "area is " + to_string(area.north_east - area.south_west) + ": must be " + to_string(policy.area_size);
    case policy::Mismatch::kDetectionThreshold:
      return "search.detection_threshold_db = " + to_string(mission.detection_threshold.value) + ": must be " +
             to_string(policy.detection_threshold.value);
    case policy::Mismatch::kListening:
      return "search.listening = " + to_string(mission.listening) + ": must be " + to_string(policy.observation.listening);
  }
  return {};
}

}  // namespace

std::vector<std::uint8_t> read_policy_bytes(const std::filesystem::path& path) {
  return host::read_bytes(path, {"a .policy file", policy::max_serialised_size()});
}

SignedPolicy signed_policy_from(Bytes bytes, const std::filesystem::path& path, const TrustedKey& trusted) {
  // The file is taken apart before its signature is checked: parse() is built for hostile bytes, and "damaged" says more than "not signed".
  std::unique_ptr<policy::FrozenPolicy> parsed = unproven_policy_from(bytes, path);
  require_signed_by(bytes, path, trusted);
  return {.policy = std::move(parsed), .bytes = std::move(bytes), .signer = trusted.file};
}

SignedPolicy signed_policy_from(Bytes bytes, const std::filesystem::path& path, const std::vector<TrustedKey>& trusted,
                                const std::string& trusted_by) {
  std::unique_ptr<policy::FrozenPolicy> parsed = unproven_policy_from(bytes, path);
  std::filesystem::path signer = signer_of(bytes, path, trusted, trusted_by);
  return {.policy = std::move(parsed), .bytes = std::move(bytes), .signer = std::move(signer)};
}

SignedPolicy load_policy(const std::filesystem::path& path, const std::filesystem::path& public_key) {
  const TrustedKey trusted = load_public_key(public_key);
  return signed_policy_from(read_policy_bytes(path), path, trusted);
}

void check_fits(const policy::FrozenPolicy& policy, const std::filesystem::path& policy_path, const config::Mission& mission,
                const std::filesystem::path& mission_path) {
  const std::string complaint = complaint_about(policy, mission);
  if (complaint.empty()) return;
  const policy::Mismatch mismatch = policy::mismatch(policy, mission);
  const std::string way_out = mismatch == policy::Mismatch::kAreaSize
                                  ? "; earshot init --area-north-m N --area-east-m E makes a search of another size, with a policy for it"
                                  : "";
  // The window is chosen when a policy is frozen; the rest, when it is trained.
  const bool is_chosen_last = mismatch == policy::Mismatch::kListening;
  throw BadInput(mission_path.string() + ": " + complaint + ", which the policy " + policy_path.string() + " was " +
                 (is_chosen_last ? "frozen" : "trained") + " with" + way_out);
}

}  // namespace earshot::host
