#pragma once

#include "firmware/policy/tables/ocean_tables.hpp"
#include "sim/search/settings.hpp"
#include "sim/sonar/snr_curve.hpp"

namespace earshot::search {

/// The ocean tables of one who is told of one ocean, and believes no other possible: the curve in steps of 100 m, or as many as fit, as far
/// as a source may be.
/// They name neither depth nor frequency: nothing but this search is to be done with them.
void make_known_ocean(const SearchSettings& settings, const sonar::SnrCurve& curve, policy::OceanTables& tables);

}  // namespace earshot::search
