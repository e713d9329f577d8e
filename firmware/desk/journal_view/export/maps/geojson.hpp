#pragma once

#include "firmware/desk/journal_view/export/maps/map_export.hpp"

namespace earshot::journal {

inline constexpr host::OutputKind kGeojsonOutput{"a GeoJSON file of Earshot", {R"({"type":"FeatureCollection","generator":"Earshot )", {}}};

/// A FeatureCollection: areas, decisions, bearings, the track. Altitudes are depths, negative. The property `kind` of a feature states what
/// it is. The track has `times` (UTC), or where the mission's clock has no date `mission_s`, of one element for each place.
/// Source: RFC 7946 (Butler et al. 2016).   Oracle: journal.maps_are_read_by_others
void write_geojson(const FlightMap& map, PiecewiseFile& file);

}  // namespace earshot::journal
