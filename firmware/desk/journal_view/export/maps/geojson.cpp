#include "firmware/desk/journal_view/export/maps/geojson.hpp"

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "firmware/desk/journal_view/export/fields.hpp"
#include "firmware/host/program/version.hpp"
#include "firmware/host/text/numbers.hpp"
#include "firmware/host/text/utc.hpp"

namespace earshot::journal {
namespace {

using Json = nlohmann::ordered_json;
using Places = std::vector<MapPlace>;

/// A text of GeoJSON in the making.
class Features {
 public:
  explicit Features(PiecewiseFile& file) : file_(file) {
    file_.write(R"({"type":"FeatureCollection","generator":"Earshot )" + program::version() + R"(","features":[)");
  }

  void point(const MapPlace& place, const Json& properties) {
    begin("Point");
    write_position(place);
    end_geometry();
    write_properties(properties);
  }
  /// @param pieces  none: no feature
  void polygon(const std::vector<Places>& pieces, const Json& properties) {
    if (pieces.empty()) return;
    begin(pieces.size() == 1 ? "Polygon" : "MultiPolygon");
    write_pieces(pieces, [this](Places ring) {
      ring.push_back(ring.front());
      file_.write("[");
      write_list(ring, [this](const MapPlace& place) { write_position(place); });
      file_.write("]");
    });
    end_geometry();
    write_properties(properties);
  }
  void line(const std::vector<Places>& pieces, const Json& properties) {
    if (pieces.empty()) return;
    write_line(pieces);
    write_properties(properties);
  }
  /// @param text  of the list of texts about its places, which one of its properties holds
  void line(const std::vector<Places>& pieces, const Json& properties, const std::string& list, const auto& text) {
    if (pieces.empty()) return;
    write_line(pieces);
    std::string open = to_line(properties);
    open.pop_back();
    file_.write(R"(,"properties":)" + open + ",\"" + list + "\":");
    write_places(pieces, [&](const MapPlace& place) { file_.write(text(place)); });
    file_.write("}}");
  }
  void finish() { file_.write("\n]}\n"); }

 private:
  void begin(std::string_view type) {
    file_.write(std::exchange(is_first_, false) ? "\n" : ",\n");
    file_.write(R"({"type":"Feature","geometry":{"type":")" + std::string(type) + R"(","coordinates":)");
  }
  void end_geometry() { file_.write("}"); }
  void write_line(const std::vector<Places>& pieces) {
    begin(pieces.size() == 1 ? "LineString" : "MultiLineString");
    write_places(pieces, [this](const MapPlace& place) { write_position(place); });
    end_geometry();
  }
  void write_properties(const Json& properties) { file_.write(R"(,"properties":)" + to_line(properties) + "}"); }

  void write_position(const MapPlace& place) {
    file_.write("[" + degrees_text(place.longitude_deg) + "," + degrees_text(place.latitude_deg));
    file_.write(place.has_depth() ? "," + altitude_text(place) + "]" : "]");
  }
  void write_list(const auto& items, const auto& write) {
    const char* before = "[";
    for (const auto& item : items) {
      file_.write(std::exchange(before, ","));
      write(item);
    }
    file_.write("]");
  }
  /// Of one piece it alone, of several a list.
  void write_pieces(const std::vector<Places>& pieces, const auto& write) {
    if (pieces.size() == 1)
      write(pieces.front());
    else
      write_list(pieces, write);
  }
  void write_places(const std::vector<Places>& pieces, const auto& write) {
    write_pieces(pieces, [&](const Places& piece) { write_list(piece, write); });
  }

  PiecewiseFile& file_;
  bool is_first_ = true;
};

}  // namespace

void write_geojson(const FlightMap& map, PiecewiseFile& file) {
  Features features(file);
  for (const FlightMap::Area& area : map.areas()) features.polygon(pieces_of_ring(area.corners), {{"kind", area.kind}});
  for (const FlightMap::Point& point : map.points()) {
    Json properties{{"kind", point.kind}, {"name", point.name}};
    if (!point.words.empty()) properties["words"] = point.words;
    properties.update(point.properties);
    features.point(point.place, properties);
  }
  for (const FlightMap::Ray& ray : map.rays())
    features.line(pieces_of_line(ray.ends),
                  {{"kind", "bearing"}, {"step", ray.step}, {"direction_deg", ray.direction_deg}, {"mirror", ray.is_mirror}});
  if (host::is_dated(map.began()))
    features.line(pieces_of_line(map.track()), {{"kind", "track"}}, "times",
                  [](const MapPlace& place) { return "\"" + host::iso_8601(place.time) + "\""; });
  else
    features.line(pieces_of_line(map.track()), {{"kind", "track"}}, "mission_s",
                  [&map](const MapPlace& place) { return host::shortest(map.mission_s(place.time)); });
  features.finish();
}

}  // namespace earshot::journal
