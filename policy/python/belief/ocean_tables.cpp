#include "policy/python/belief/ocean_tables.hpp"

#include <array>
#include <sstream>
#include <utility>

#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/policy/tables_bytes.hpp"
#include "firmware/host/text/numbers.hpp"
#include "policy/tables/believed_ocean.hpp"
#include "policy/tables/make_tables.hpp"
#include "policy/tables/merge.hpp"
#include "policy/tables/unsigned_tables.hpp"

namespace earshot::python {
namespace {

std::vector<tables::BelievedOcean> oceans_of(const TablesAsked& asked) {
  std::vector<tables::BelievedOcean> oceans;
  for (const auto& ocean : asked.oceans) {
    if (const auto* const environment = std::get_if<std::shared_ptr<ocean::Environment>>(&ocean)) {
      oceans.push_back({.file = (*environment)->name, .environment = **environment});
      continue;
    }
    for (tables::BelievedOcean& other : tables::oceans_in(std::get<std::filesystem::path>(ocean))) oceans.push_back(std::move(other));
  }
  return oceans;
}

}  // namespace

Tables tables_of(std::vector<std::uint8_t> bytes, const std::filesystem::path& name) {
  std::shared_ptr<const policy::OceanTables> of = host::tables_from(bytes, name);
  return {std::move(of), std::move(bytes)};
}

Tables make_tables(const TablesAsked& asked, const std::function<void(double share)>& progress) {
  const std::vector<tables::BelievedOcean> oceans = oceans_of(asked);
  tables::require_one_frequency(oceans);
  const auto refuse = [&asked](const tables::BelievedOcean& ocean) {
    std::ostringstream text;
    text << "vehicle_depth = " << asked.plan.vehicle_depth.value << ": the sea floor of " << ocean.environment.name
         << " lies above the vehicle";
    throw host::BadInput(text.str());
  };
  const std::vector<tables::OceanCurve> curves = tables::curves_of(oceans, asked.plan, progress, refuse);
  const tables::Merged merged = tables::merge(curves, asked.at_most);
  const auto made = tables::make_tables(merged.curves, curves, asked.plan, oceans.front().environment.source.frequency,
                                        {{"made_by", "earshot.tables"},
                                         {"oceans", std::to_string(oceans.size())},
                                         {"curves", std::to_string(curves.size())},
                                         {"merged_within_db", host::decimals(merged.most_difference_db, 1)}});
  const std::array<std::uint8_t, policy::kPublicKeySize> nobody{};
  return tables_of(tables::unsigned_bytes(*made, nobody), "the tables");
}

}  // namespace earshot::python
