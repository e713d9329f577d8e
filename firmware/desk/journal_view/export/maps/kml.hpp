#pragma once

#include "firmware/desk/journal_view/export/maps/map_export.hpp"

namespace earshot::journal {

inline constexpr host::OutputKind kKmlOutput{
    "a KML file of Earshot", {"<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<kml ", {}}, "<Document id=\"earshot\">"};

/// Placemarks: areas, decisions with their words, bearings, and the track, as a gx:Track where the mission's clock has a date and else as a
/// LineString. Altitudes are depths, negative; a viewer draws all of it on the surface.
/// Source: OGC 07-147r2 (KML 2.2); Google's schema kml22gx.xsd (gx:Track).   Oracle: journal.maps_are_read_by_others
void write_kml(const FlightMap& map, PiecewiseFile& file);

}  // namespace earshot::journal
