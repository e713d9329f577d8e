#pragma once

#include "firmware/desk/journal_view/export/maps/map_export.hpp"

namespace earshot::journal {

inline constexpr host::OutputKind kGpxOutput{
    "a GPX file of Earshot", {"<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<gpx ", {}}, "creator=\"Earshot "};

/// Way-points (decisions, declared places, the safe point) and the track. GPX has no areas. There are times where the mission's clock has a
/// date; `ele` is the depth, negative.
/// Source: GPX 1.1 Schema Documentation (topografix.com/GPX/1/1).   Oracle: journal.maps_are_read_by_others
void write_gpx(const FlightMap& map, PiecewiseFile& file);

}  // namespace earshot::journal
