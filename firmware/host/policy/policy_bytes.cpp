#include "firmware/host/policy/policy_bytes.hpp"

#include "firmware/config/capacities.hpp"
#include "firmware/host/file/printable.hpp"
#include "firmware/host/toml/table_reader.hpp"
#include "firmware/policy/format/policy_format.hpp"

namespace earshot::host {
namespace {

using policy::PolicyComplaint;
using policy::PolicyFault;

/// Of another version of the format than this program's: the versions and the way out.
std::string complaint_about_version(std::uint32_t version, const std::string& path) {
  const std::string text = "is of version " + std::to_string(version) + " of the .policy format, this program reads version " +
                           std::to_string(policy::kFormatVersion);
  if (version > policy::kFormatVersion) return text + ": it was frozen by a later one";
  return text + "; no program reads it any more: freeze the model that it was made from, or one trained anew: earshot freeze MODEL -o " +
         path + " --force --key YOUR.key";
}

/// The first thing that is wrong with provenance; empty when nothing is.
std::string complaint_about_provenance(std::string_view text) {
  if (!is_utf8(text)) return "holds bytes that are not UTF-8";
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    if (end == std::string_view::npos) return "ends within a line";
    const std::size_t equals = text.substr(0, end).find(" = ");
    if (equals == std::string_view::npos || equals == 0) return "holds a line that is not \"key = value\"";
    text.remove_prefix(end + 1);
  }
  return {};
}

std::string at_most(std::size_t count, const char* what) {
  return std::to_string(count) + " " + what;
}

/// The most that this program holds; a microcontroller's holds less.
std::string capacities() {
  return at_most(config::kMaxObservation, "observations, ") + at_most(config::kMaxActions, "actions, ") +
         at_most(config::kMaxLayerWidth, "units in each of ") + at_most(config::kMaxHiddenLayers, "hidden layers, ") +
         at_most(config::kMaxBeliefCells, "cells of a belief, ") + at_most(config::kMaxProvenance, "bytes of provenance");
}

}  // namespace

std::unique_ptr<policy::FrozenPolicy> unproven_policy_from(std::span<const std::uint8_t> bytes, const std::filesystem::path& path) {
  auto policy = std::make_unique<policy::FrozenPolicy>();
  PolicyComplaint complaint;
  if (policy::parse(bytes, *policy, complaint) != Status::kOk) throw BadInput(to_string(complaint, path));
  require_provenance({policy->provenance.begin(), policy->provenance.end()}, path);
  return policy;
}

std::unique_ptr<policy::FrozenPolicy> policy_from(std::span<const std::uint8_t> bytes, const std::filesystem::path& path) {
  std::unique_ptr<policy::FrozenPolicy> policy = unproven_policy_from(bytes, path);
  require_repeats_golden(*policy, path);
  return policy;
}

void require_repeats_golden(const policy::FrozenPolicy& policy, const std::filesystem::path& path) {
  const auto memory = std::make_unique<policy::SearchMemory>();
  const auto tables = std::make_unique<policy::OceanTables>();
  if (!policy::repeats_golden(policy, *memory, *tables)) throw BadInput(to_string({.fault = PolicyFault::kGoldenMismatch}, path));
}

void require_provenance(std::string_view provenance, const std::filesystem::path& path) {
  const std::string complaint = complaint_about_provenance(provenance);
  if (!complaint.empty()) throw BadInput(path.string() + ": section PROV " + complaint);
}

std::string section_of(const PolicyComplaint& complaint) {
  if (complaint.section == policy::SectionTag{}) return "";
  const std::string tag(complaint.section.begin(), complaint.section.end());
  const std::string version =
      complaint.fault == PolicyFault::kUnknownSectionVersion ? ", version " + std::to_string(complaint.version) + "," : "";
  return "section " + printable(tag) + version + " ";
}

std::string to_string(const PolicyComplaint& complaint, const std::filesystem::path& path) {
  const std::string name = path.string() + ": ";
  if (complaint.fault == PolicyFault::kUnknownVersion) return name + complaint_about_version(complaint.version, path.string());
  const std::string text = name + section_of(complaint) + std::string(policy::to_string(complaint.fault));
  if (complaint.fault == PolicyFault::kTooLarge)
    return text + ": its weights take " + std::to_string(complaint.size) + " bytes; " +
           at_most(sizeof(policy::Network::numbers), "bytes, and ") + at_most(config::kMaxLayerWidth, "units in a hidden layer, fit");
  return complaint.fault == PolicyFault::kBadShape ? text + ": " + capacities() : text;
}

}  // namespace earshot::host
