#include "firmware/host/policy/tables_bytes.hpp"

#include <string_view>

#include "firmware/config/capacities.hpp"
#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/file/input_file.hpp"
#include "firmware/host/file/printable.hpp"
#include "firmware/host/policy/policy_bytes.hpp"
#include "firmware/policy/tables/tables_format.hpp"

namespace earshot::host {
namespace {

using policy::PolicyComplaint;
using policy::PolicyFault;

/// The most that this program holds; a microcontroller's holds less.
std::string capacities() {
  return std::to_string(config::kMaxOceanTables) + " tables of " + std::to_string(config::kMaxTableRanges) + " ranges, names of " +
         std::to_string(config::kMaxTableName) + " bytes, " + std::to_string(config::kMaxProvenance) + " bytes of provenance";
}

std::string complaint_about_version(std::uint32_t version) {
  return "is of version " + std::to_string(version) + " of the .tables format, this program reads version " +
         std::to_string(policy::kTablesVersion) +
         (version > policy::kTablesVersion ? ": it was made by a later one" : "; make it again with earshot tables");
}

}  // namespace

std::vector<std::uint8_t> read_tables_bytes(const std::filesystem::path& path) {
  return read_bytes(path, {"a .tables file", policy::max_tables_size()});
}

std::unique_ptr<policy::OceanTables> tables_from(std::span<const std::uint8_t> bytes, const std::filesystem::path& path) {
  auto tables = std::make_unique<policy::OceanTables>();
  PolicyComplaint complaint;
  if (policy::parse(bytes, *tables, complaint) != Status::kOk) throw BadInput(tables_complaint(complaint, path));
  require_readable(*tables, path);
  return tables;
}

void require_readable(const policy::OceanTables& tables, const std::filesystem::path& path) {
  for (const policy::OceanTable& table : tables.tables)
    if (!is_utf8({table.name.begin(), table.name.end()})) throw BadInput(path.string() + ": section OCNS holds a name that is not UTF-8");
  require_provenance({tables.provenance.begin(), tables.provenance.end()}, path);
}

std::string tables_complaint(const PolicyComplaint& complaint, const std::filesystem::path& path) {
  const std::string name = path.string() + ": ";
  if (complaint.fault == PolicyFault::kBadMagic) return name + "is not a .tables file";
  if (complaint.fault == PolicyFault::kUnknownVersion) return name + complaint_about_version(complaint.version);
  const std::string text = name + section_of(complaint) + std::string(policy::to_string(complaint.fault));
  return complaint.fault == PolicyFault::kBadShape ? text + ": " + capacities() : text;
}

}  // namespace earshot::host
