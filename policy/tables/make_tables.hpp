#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "firmware/core/units.hpp"
#include "firmware/policy/tables/ocean_tables.hpp"
#include "policy/tables/ocean_curve.hpp"

namespace earshot::tables {

/// A name that fits a table: the curve's, of which so much is cut off, between two characters, that its detail has room. Where what
/// stands behind its last ": " is short, it tells variants apart: what is cut then stands before that.
[[nodiscard]] std::string short_name(const OceanCurve& curve);

/// The tables that fly, of curves that are few enough: priors that add up to one, SNRs in half decibels, sea floors to the metre.
/// @param all  every curve that the ones given stand for: the depths of their sea floors and sources are said
/// @param provenance  name and value of each line
/// Throws host::BadInput when provenance, ranges or tables do not fit firmware's capacities, or an SNR is no number.
[[nodiscard]] std::unique_ptr<policy::OceanTables> make_tables(const std::vector<OceanCurve>& curves, const std::vector<OceanCurve>& all,
                                                               const CurvePlan& plan, Hertz frequency,
                                                               const std::vector<std::pair<std::string, std::string>>& provenance);

}  // namespace earshot::tables
