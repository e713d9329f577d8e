#pragma once

#include <cstdint>
#include <initializer_list>
#include <string_view>

#include "firmware/policy/tables/ocean_tables.hpp"

namespace earshot::policy {

inline OceanTable made_up_table(std::string_view name, float prior, float sea_depth_m, std::initializer_list<int> snr_half_db) {
  OceanTable table;
  for (const char character : name) static_cast<void>(table.name.push_back(character));
  table.prior = prior;
  table.sea_depth_m = sea_depth_m;
  std::size_t i = 0;
  for (const int snr : snr_half_db) table.snr_half_db[i++] = static_cast<std::int8_t>(snr);
  return table;
}

/// Two oceans of three ranges.
inline OceanTables made_up_tables() {
  OceanTables tables;
  tables.frequency = Hertz{20.0};
  tables.receiver_depth = Meters{300.0};
  tables.source_depth = {Meters{10.0}, Meters{50.0}};
  tables.sea_depth = {Meters{200.0}, Meters{4000.0}};
  tables.range_step = Meters{100.0};
  tables.range_count = 3;
  static_cast<void>(tables.tables.push_back(made_up_table("deep", 0.75F, 3000.0F, {40, -3, -128})));
  static_cast<void>(tables.tables.push_back(made_up_table("shelf", 0.25F, 200.0F, {127, 0, 5})));
  for (const char character : std::string_view("a = b\n")) static_cast<void>(tables.provenance.push_back(character));
  return tables;
}

}  // namespace earshot::policy
