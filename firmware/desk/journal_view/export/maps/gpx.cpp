#include "firmware/desk/journal_view/export/maps/gpx.hpp"

#include <string>

#include "firmware/desk/journal_view/export/maps/xml.hpp"
#include "firmware/host/program/version.hpp"
#include "firmware/host/text/utc.hpp"

namespace earshot::journal {
namespace {

/// GPX has longitudes below 180 degrees.
std::string longitude_text(double degrees) {
  const std::string text = degrees_text(degrees);
  return text == degrees_text(180.0) ? "-" + text : text;
}

/// Its position, depth and time. @param element  of type wptType
void open_place(XmlFile& xml, const char* element, const MapPlace& place, bool has_time) {
  xml.open(element, {{"lat", degrees_text(place.latitude_deg)}, {"lon", longitude_text(place.longitude_deg)}});
  if (place.has_depth()) xml.element("ele", altitude_text(place));
  if (has_time && host::is_dated(place.time)) xml.element("time", host::iso_8601(place.time));
}

}  // namespace

void write_gpx(const FlightMap& map, PiecewiseFile& file) {
  XmlFile xml(file);
  xml.open("gpx", {{"version", "1.1"}, {"creator", "Earshot " + program::version()}, {"xmlns", "http://www.topografix.com/GPX/1/1"}});
  for (const FlightMap::Point& point : map.points()) {
    open_place(xml, "wpt", point.place, point.has_time);
    xml.element("name", point.name);
    if (!point.words.empty()) xml.element("desc", point.words);
    xml.element("type", point.kind);
    xml.close();
  }
  if (!map.track().empty()) {
    xml.open("trk");
    xml.element("name", "track");
    xml.open("trkseg");
    for (const MapPlace& place : map.track()) {
      open_place(xml, "trkpt", place, true);
      xml.close();
    }
    xml.close();
    xml.close();
  }
  xml.close();
}

}  // namespace earshot::journal
