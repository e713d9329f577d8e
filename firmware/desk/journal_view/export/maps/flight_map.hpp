#pragma once

#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "firmware/desk/journal_view/export/maps/places.hpp"
#include "firmware/host/journal/reading/entry.hpp"
#include "firmware/messages/navigation.hpp"

namespace earshot::journal {

/// What a map shows of a flight, out of the entries of its journal.
class FlightMap {
 public:
  /// Of a longer track every second fix is kept, or every fourth, and so on, and its last: so memory does not grow with the journal.
  static constexpr std::size_t kMostTrackPlaces = 65'536;

  struct Area {
    std::string kind;  ///< "operating_area", "fence_inside", "fence_save", "fence_halt", "no_surface_zone"
    std::vector<MapPlace> corners;
  };
  struct Point {
    std::string kind;   ///< "decision", "declared_place", "safe_point"
    std::string name;   ///< "step 3"
    std::string words;  ///< about it, in a sentence or more; may be empty
    MapPlace place;
    bool has_time = false;
    nlohmann::ordered_json properties;  ///< besides these
  };
  /// A bearing from where it was heard to the edge of the operating area.
  struct Ray {
    std::uint32_t step = 0;
    double direction_deg = 0.0;
    bool is_mirror = false;  ///< the other direction of what cannot tell left from right
    std::vector<MapPlace> ends;
  };

  explicit FlightMap(const n2k::LocalPlane& plane) : plane_(plane) {}
  void take(const Entry& entry);
  /// No entry comes any more.
  void finish();

  /// Of the journal's first record.
  [[nodiscard]] Time began() const { return began_.value_or(Time{}); }
  /// Seconds since then.
  [[nodiscard]] double mission_s(Time time) const { return static_cast<double>((time - began()).us) / 1e6; }
  [[nodiscard]] const std::vector<Area>& areas() const { return areas_; }
  [[nodiscard]] const std::vector<Point>& points() const { return points_; }
  [[nodiscard]] const std::vector<Ray>& rays() const { return rays_; }
  /// Usable fixes in the order of their times; of two of one time, and of one that comes late, the first is there.
  [[nodiscard]] const std::vector<MapPlace>& track() const { return track_; }
  /// "12 decisions, a track of 4797 places"; and what is not there.
  [[nodiscard]] std::string what() const;

 private:
  void note(const messages::MissionRecord& record);
  void note(const messages::Navigation& fix);
  void note(const messages::Decision& decision, const Content& content);
  void add_area(std::string kind, std::span<const NorthEast> corners);
  void add_ray(const messages::Decision& decision, Radians direction, bool is_mirror);
  void keep(const MapPlace& fix);
  /// Nothing, and counted, where the plane does not reach.
  [[nodiscard]] std::optional<MapPlace> map(NorthEast place);
  /// Likewise, with the depth of the newest fix.
  [[nodiscard]] std::optional<MapPlace> map_vehicle(NorthEast place, Time time);

  n2k::LocalPlane plane_;
  std::optional<Time> began_;
  std::optional<Rectangle> operating_area_;
  std::vector<Area> areas_;
  std::vector<Point> points_;
  std::vector<Ray> rays_;
  std::vector<MapPlace> track_;
  std::optional<MapPlace> newest_fix_;
  std::size_t fixes_ = 0;
  std::size_t fixes_of_a_place_ = 1;  ///< one in so many is kept
  std::size_t decisions_ = 0;
  std::size_t out_of_reach_ = 0;
};

}  // namespace earshot::journal
