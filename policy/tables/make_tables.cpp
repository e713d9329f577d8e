#include "policy/tables/make_tables.hpp"

#include <algorithm>
#include <cmath>

#include "firmware/config/capacities.hpp"
#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/file/printable.hpp"

namespace earshot::tables {
namespace {

using host::BadInput;

/// @param what  is full: "tables"
template <class Vector, class Value>
void append(Vector& vector, const Value& value, const char* what) {
  if (vector.push_back(value) != Status::kOk)
    throw BadInput(std::string(what) + ": more than the " + std::to_string(Vector::capacity()) + " that a vehicle holds");
}

policy::OceanTable table_of(const OceanCurve& curve, double all_weights) {
  policy::OceanTable table;
  for (const char character : short_name(curve)) append(table.name, character, "bytes of a name");
  table.prior = static_cast<float>(curve.weight / all_weights);
  table.sea_depth_m = static_cast<float>(std::round(curve.sea_depth.value));
  for (std::size_t i = 0; i < curve.snr_db.size(); ++i) {
    if (!std::isfinite(curve.snr_db[i])) throw BadInput(curve.name + ": its SNR is no number");
    table.snr_half_db[i] = policy::to_half_db(curve.snr_db[i]);
  }
  return table;
}

/// To the metre.
policy::DepthRange range_of(const std::vector<OceanCurve>& curves, Meters OceanCurve::*depth) {
  const auto [least, most] = std::ranges::minmax(curves, {}, depth);
  return {.least = Meters{std::round((least.*depth).value)}, .most = Meters{std::round((most.*depth).value)}};
}

}  // namespace

std::string short_name(const OceanCurve& curve) {
  constexpr std::size_t kLongestVariant = config::kMaxTableName / 2;
  const std::string& name = curve.name;
  const std::size_t colon = name.rfind(": ");
  const bool is_variant = name.size() + curve.detail.size() > config::kMaxTableName && colon != std::string::npos &&
                          name.size() - colon + curve.detail.size() <= kLongestVariant;
  const std::string detail = (is_variant ? name.substr(colon) : "") + curve.detail;
  std::size_t size = std::min(is_variant ? colon : name.size(), config::kMaxTableName - std::min(detail.size(), config::kMaxTableName));
  const auto goes_on = [&name](std::size_t at) { return at < name.size() && (static_cast<unsigned char>(name[at]) & 0xC0U) == 0x80U; };
  while (size > 0 && goes_on(size)) --size;
  const std::string shortened = name.substr(0, size) + detail;
  return shortened.empty() ? "unnamed" : shortened;
}

std::unique_ptr<policy::OceanTables> make_tables(const std::vector<OceanCurve>& curves, const std::vector<OceanCurve>& all,
                                                 const CurvePlan& plan, Hertz frequency,
                                                 const std::vector<std::pair<std::string, std::string>>& provenance) {
  if (plan.range_count > config::kMaxTableRanges)
    throw BadInput("ranges: more than the " + std::to_string(config::kMaxTableRanges) + " that a vehicle holds");
  auto tables = std::make_unique<policy::OceanTables>();
  tables->frequency = frequency;
  tables->receiver_depth = plan.vehicle_depth;
  tables->source_depth = range_of(all, &OceanCurve::source_depth);
  tables->sea_depth = range_of(all, &OceanCurve::sea_depth);
  tables->range_step = plan.range_step;
  tables->range_count = static_cast<std::uint16_t>(plan.range_count);
  double weights = 0.0;
  for (const OceanCurve& curve : curves) weights += curve.weight;
  for (const OceanCurve& curve : curves) append(tables->tables, table_of(curve, weights), "tables");
  for (const auto& [name, value] : provenance) {
    for (const char character : host::printable(name) + " = " + host::printable(value) + "\n")
      append(tables->provenance, character, "bytes of provenance");
  }
  return tables;
}

}  // namespace earshot::tables
