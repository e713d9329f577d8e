#include "policy/tables/description.hpp"

#include <algorithm>
#include <ostream>
#include <string>

#include "firmware/config/capacities.hpp"
#include "firmware/host/file/printable.hpp"
#include "firmware/host/text/numbers.hpp"

namespace earshot::tables {
namespace {

constexpr Decibels kThreshold{10.0};

}  // namespace

std::string from_to(policy::DepthRange depths) {
  const std::string least = depths.least == depths.most ? "" : host::significant(depths.least.value, 10) + " to ";
  return least + host::significant(depths.most.value, 10) + " m";
}

Meters heard_to(const policy::OceanTable& table, const policy::OceanTables& tables, Decibels threshold) {
  for (std::size_t i = tables.range_count; i > 0; --i)
    if (double{table.snr_db(i - 1)} >= threshold.value) return static_cast<double>(i - 1) * tables.range_step;
  return Meters{-1.0};
}

void describe(std::ostream& out, const policy::OceanTables& tables) {
  out << host::formatted("%.10g Hz heard at %.10g m from sources at %s; sea floors at %s; %u ranges, every %.10g m\n",
                         tables.frequency.value, tables.receiver_depth.value, from_to(tables.source_depth).c_str(),
                         from_to(tables.sea_depth).c_str(), unsigned{tables.range_count}, tables.range_step.value)
      << "sea floor m   prior   detected to (km)   name\n";
  for (const policy::OceanTable& table : tables.tables) {
    const Meters heard = heard_to(table, tables, kThreshold);
    const std::string km = heard.value < 0.0 ? "-" : (heard == reach(tables) ? ">" : "") + host::decimals(heard.value / 1000.0, 1);
    out << host::formatted("%11.0f   %.3f   %16s   ", double{table.sea_depth_m}, double{table.prior}, km.c_str())
        << host::printable({table.name.begin(), table.name.end()}) << "\n";
  }
  out << host::formatted("detected: an SNR of %.10g dB or more\n", kThreshold.value);
  const auto is_cut = [](const policy::OceanTable& table) { return table.name.size() == config::kMaxTableName; };
  if (std::ranges::any_of(tables.tables, is_cut))
    out << host::formatted("a file of tables holds %u bytes of a name: the rest of a longer one is not in it\n",
                           static_cast<unsigned>(config::kMaxTableName));
}

}  // namespace earshot::tables
