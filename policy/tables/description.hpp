#pragma once

#include <iosfwd>
#include <string>

#include "firmware/core/units.hpp"
#include "firmware/policy/tables/ocean_tables.hpp"

namespace earshot::tables {

/// The furthest range at which the SNR is the threshold or more; nothing above it gives no range, below zero.
/// Oracle: TablesDescription.*
[[nodiscard]] Meters heard_to(const policy::OceanTable& table, const policy::OceanTables& tables, Decibels threshold);

/// "30 m", "30 to 50 m"
[[nodiscard]] std::string from_to(policy::DepthRange depths);

/// What tables are of, and a line for each of them: sea floor, prior, how far the threshold of 10 dB is heard, name.
void describe(std::ostream& out, const policy::OceanTables& tables);

}  // namespace earshot::tables
