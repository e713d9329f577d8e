#include "firmware/desk/journal_view/export_kinds.hpp"

#include "firmware/desk/journal_view/export/maps/geojson.hpp"
#include "firmware/desk/journal_view/export/maps/gpx.hpp"
#include "firmware/desk/journal_view/export/maps/kml.hpp"
#include "firmware/desk/journal_view/export/mcap_export.hpp"
#include "firmware/desk/journal_view/export/record_lines.hpp"
#include "firmware/desk/journal_view/export/turn_table.hpp"

namespace earshot::journal {
namespace {

using Path = std::filesystem::path;
using Plane = std::optional<n2k::LocalPlane>;
using Made = std::unique_ptr<Export>;

template <MapExport::Write kWrite>
Made make_map(const Path& path, const Plane& plane) {
  return std::make_unique<MapExport>(path, plane.value(), kWrite);
}

}  // namespace

const std::array<ExportKind, kExportKindCount> kExportKinds{{
    {.option = "--csv",
     .help = "write a table, a row for every turn",
     .output = kTurnTableOutput,
     .origin = Origin::kUsed,
     .make = [](const Path& path, const Plane& plane) -> Made { return std::make_unique<TurnTable>(path, plane); }},
    {.option = "--jsonl",
     .help = "write every record as a JSON object on a line",
     .output = kRecordLinesOutput,
     .make = [](const Path& path, const Plane& /*plane*/) -> Made { return std::make_unique<RecordLines>(path); }},
    {.option = "--mcap",
     .help = "write an MCAP file, for Foxglove, Lichtblick and others",
     .output = kMcapOutput,
     .origin = Origin::kUsed,
     .make = [](const Path& path, const Plane& plane) -> Made { return std::make_unique<McapExport>(path, plane); }},
    {.option = "--geojson",
     .help = "write areas, track and decisions as GeoJSON, for QGIS and others",
     .output = kGeojsonOutput,
     .origin = Origin::kNeeded,
     .make = make_map<write_geojson>},
    {.option = "--gpx",
     .help = "write track and decisions as GPX, for chart plotters",
     .output = kGpxOutput,
     .origin = Origin::kNeeded,
     .make = make_map<write_gpx>},
    {.option = "--kml",
     .help = "write areas, track and decisions as KML, for Google Earth and others",
     .output = kKmlOutput,
     .origin = Origin::kNeeded,
     .make = make_map<write_kml>},
}};

}  // namespace earshot::journal
