#include "firmware/desk/journal_view/export/maps/kml.hpp"

#include <algorithm>
#include <span>
#include <string>
#include <vector>

#include "firmware/desk/journal_view/export/maps/xml.hpp"
#include "firmware/host/text/utc.hpp"

namespace earshot::journal {
namespace {

using Places = std::vector<MapPlace>;

/// @param between  longitude, latitude and altitude
std::string coordinates(const MapPlace& place, const char* between) {
  return degrees_text(place.longitude_deg) + between + degrees_text(place.latitude_deg) +
         (place.has_depth() ? between + altitude_text(place) : "");
}

void write_coordinates(XmlFile& xml, std::span<const MapPlace> places) {
  xml.open("coordinates");
  for (const MapPlace& place : places) xml.text(coordinates(place, ",") + "\n");
  xml.close();
}

/// @param pieces  one is a geometry by itself, several are in a MultiGeometry
void write_pieces(XmlFile& xml, const std::vector<Places>& pieces, const auto& write) {
  if (pieces.size() > 1) xml.open("MultiGeometry");
  for (const Places& piece : pieces) write(piece);
  if (pieces.size() > 1) xml.close();
}

void write_line(XmlFile& xml, const std::vector<Places>& pieces) {
  write_pieces(xml, pieces, [&xml](const Places& piece) {
    xml.open("LineString");
    xml.element("tessellate", "1");
    write_coordinates(xml, piece);
    xml.close();
  });
}

void write_polygon(XmlFile& xml, const std::vector<Places>& pieces) {
  write_pieces(xml, pieces, [&xml](Places ring) {
    ring.push_back(ring.front());
    xml.open("Polygon");
    xml.element("tessellate", "1");
    xml.open("outerBoundaryIs");
    xml.open("LinearRing");
    write_coordinates(xml, ring);
    for (int i = 0; i < 3; ++i) xml.close();
  });
}

void write_track_in_time(XmlFile& xml, const Places& track) {
  xml.open("gx:Track");
  for (const MapPlace& place : track) xml.element("when", host::iso_8601(place.time));
  for (const MapPlace& place : track) xml.element("gx:coord", coordinates(place, " "));
  xml.close();
}

void begin_placemark(XmlFile& xml, const std::string& name, const std::string& style) {
  xml.open("Placemark");
  xml.element("name", name);
  xml.element("styleUrl", "#" + style);
}

void write_point(XmlFile& xml, const FlightMap::Point& point) {
  xml.open("Placemark");
  xml.element("name", point.name);
  if (!point.words.empty()) xml.element("description", point.words);
  if (point.has_time && host::is_dated(point.place.time)) {
    xml.open("TimeStamp");
    xml.element("when", host::iso_8601(point.place.time));
    xml.close();
  }
  xml.open("Point");
  xml.element("coordinates", coordinates(point.place, ","));
  xml.close();
  xml.close();
}

/// @param colour  aabbggrr
void write_style(XmlFile& xml, const char* id, const char* colour, const char* width) {
  xml.open("Style", {{"id", id}});
  xml.open("LineStyle");
  xml.element("color", colour);
  xml.element("width", width);
  xml.close();
  xml.open("PolyStyle");
  xml.element("fill", "0");
  xml.close();
  xml.close();
}

/// "fence_halt" as people read it.
std::string words_of(std::string kind) {
  std::ranges::replace(kind, '_', ' ');
  return kind;
}

}  // namespace

void write_kml(const FlightMap& map, PiecewiseFile& file) {
  XmlFile xml(file);
  xml.open("kml", {{"xmlns", "http://www.opengis.net/kml/2.2"}, {"xmlns:gx", "http://www.google.com/kml/ext/2.2"}});
  xml.open("Document", {{"id", "earshot"}});
  xml.element("name", host::is_dated(map.began()) ? "Earshot, " + host::date_and_time(map.began()) + " UTC" : "Earshot");
  write_style(xml, "area", "ffb27200", "2");     // of a palette that the colour-blind can tell apart: blue,
  write_style(xml, "bearing", "ff009fe6", "1");  // orange,
  write_style(xml, "track", "ff005ed5", "3");    // vermilion
  for (const FlightMap::Area& area : map.areas()) {
    const std::vector<Places> pieces = pieces_of_ring(area.corners);
    if (pieces.empty()) continue;
    begin_placemark(xml, words_of(area.kind), "area");
    write_polygon(xml, pieces);
    xml.close();
  }
  for (const FlightMap::Point& point : map.points()) write_point(xml, point);
  for (const FlightMap::Ray& ray : map.rays()) {
    begin_placemark(xml, "bearing at step " + std::to_string(ray.step) + (ray.is_mirror ? ", its mirror" : ""), "bearing");
    write_line(xml, pieces_of_line(ray.ends));
    xml.close();
  }
  if (const std::vector<Places> pieces = pieces_of_line(map.track()); !pieces.empty()) {
    begin_placemark(xml, "track", "track");
    if (host::is_dated(map.began()))
      write_track_in_time(xml, map.track());
    else
      write_line(xml, pieces);
    xml.close();
  }
  xml.close();
  xml.close();
}

}  // namespace earshot::journal
