#include "firmware/host/policy/tables_bytes.hpp"

#include <cmath>
#include <limits>
#include <sstream>
#include <string_view>

#include "firmware/config/capacities.hpp"
#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/file/input_file.hpp"
#include "firmware/host/file/printable.hpp"
#include "firmware/host/policy/policy_bytes.hpp"
#include "firmware/policy/belief/search_bounds.hpp"
#include "firmware/policy/tables/tables_format.hpp"

namespace earshot::host {
namespace {

using policy::PolicyComplaint;
using policy::PolicyFault;

/// The most that this program holds; a microcontroller's holds less.
std::string capacities_of_tables() {
  return std::to_string(config::kMaxOceanTables) + " tables of " + std::to_string(config::kMaxTableRanges) + " ranges, names of " +
         std::to_string(config::kMaxTableName) + " bytes, " + std::to_string(config::kMaxProvenance) + " bytes of provenance";
}

std::string complaint_about_version(std::uint32_t version) {
  return "is of version " + std::to_string(version) + " of the .tables format, this program reads version " +
         std::to_string(policy::kTablesVersion) +
         (version > policy::kTablesVersion ? ": it was made by a later one" : "; make it again with earshot tables");
}

/// The first of their numbers that cannot be, as "prior of "mud" = 0 (1e-06 to 1e+06)".
std::string number_out_of_range(const policy::OceanTables& t) {
  std::ostringstream problem;
  const auto is_out = [&problem](const std::string& name, double value, double low, double high) {
    if (value >= low && value <= high) return false;
    problem << name << " = " << (std::isnan(value) ? std::numeric_limits<double>::quiet_NaN() : value) << " (" << low << " to " << high
            << ")";
    return true;
  };
  const auto is_no_depth = [&](const std::string& name, double depth_m) {
    if (depth_m > 0.0 && depth_m <= policy::kMostDepth_m) return false;
    problem << name << " = " << depth_m << " m (above 0, at most " << policy::kMostDepth_m << ")";
    return true;
  };
  const auto is_no_range = [&](const std::string& name, const policy::DepthRange& depths) {
    return is_no_depth("least " + name, depths.least.value) || is_no_depth("greatest " + name, depths.most.value) ||
           is_out("greatest " + name, depths.most.value, depths.least.value, policy::kMostDepth_m);
  };
  if (is_out("frequency in Hz", t.frequency.value, policy::kLeastFrequency_hz, policy::kMostFrequency_hz) ||
      is_no_depth("depth of the vehicle", t.receiver_depth.value) || is_no_range("depth of the source", t.source_depth) ||
      is_no_range("depth of the sea floor", t.sea_depth) ||
      is_out("range step in m", t.range_step.value, policy::kLeastLength_m, policy::kMostRangeStep_m))
    return problem.str();
  for (const policy::OceanTable& table : t.tables) {
    const std::string of = " of \"" + std::string(table.name.begin(), table.name.end()) + "\"";
    if (is_out("prior" + of, double{table.prior}, policy::kLeastPrior, policy::kMostPrior) ||
        is_out("depth of the sea floor in m" + of, double{table.sea_depth_m}, t.sea_depth.least.value, t.sea_depth.most.value))
      return problem.str();
  }
  return problem.str();
}

/// "PATH: section OCNS is missing, or not in its place", in the words of `.tables` files. @param tables  as far as they were read
std::string tables_complaint(const PolicyComplaint& complaint, const policy::OceanTables& tables, const std::filesystem::path& path) {
  const std::string name = path.string() + ": ";
  if (complaint.fault == PolicyFault::kBadMagic) return name + "is not a .tables file";
  if (complaint.fault == PolicyFault::kUnknownVersion) return name + complaint_about_version(complaint.version);
  const std::string text = name + section_of(complaint) + std::string(policy::to_string(complaint.fault));
  if (complaint.fault == PolicyFault::kOutOfRange) return text + ": " + printable(number_out_of_range(tables));
  return complaint.fault == PolicyFault::kBadShape ? text + ": " + capacities_of_tables() : text;
}

}  // namespace

std::vector<std::uint8_t> read_tables_bytes(const std::filesystem::path& path) {
  return read_bytes(path, {"a .tables file", policy::max_tables_size()});
}

std::unique_ptr<policy::OceanTables> tables_from(std::span<const std::uint8_t> bytes, const std::filesystem::path& path) {
  auto tables = std::make_unique<policy::OceanTables>();
  PolicyComplaint complaint;
  if (policy::parse(bytes, *tables, complaint) != Status::kOk) throw BadInput(tables_complaint(complaint, *tables, path));
  require_readable(*tables, path);
  return tables;
}

void require_readable(const policy::OceanTables& tables, const std::filesystem::path& path) {
  for (const policy::OceanTable& table : tables.tables)
    if (!is_utf8({table.name.begin(), table.name.end()})) throw BadInput(path.string() + ": section OCNS holds a name that is not UTF-8");
  require_provenance({tables.provenance.begin(), tables.provenance.end()}, path);
}

}  // namespace earshot::host
