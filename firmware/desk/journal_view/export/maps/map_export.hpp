#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "firmware/desk/journal_view/export/export.hpp"
#include "firmware/desk/journal_view/export/maps/flight_map.hpp"

namespace earshot::journal {

/// A file for maps, written when the journal has been read: each of its formats wants what comes last in a journal before what comes first.
class MapExport final : public Export {
 public:
  using Write = void (*)(const FlightMap& map, PiecewiseFile& file);

  /// @param plane  about the mission's origin. @param write  in which format: write_geojson, write_gpx, write_kml
  MapExport(const std::filesystem::path& path, const n2k::LocalPlane& plane, Write write) : file_(path), map_(plane), write_(write) {}
  void take(const Entry& entry, std::span<const Event> /*events*/) override { map_.take(entry); }
  void finish(std::span<const Event> /*events*/) override {
    map_.finish();
    write_(map_, file_);
    file_.commit();
  }
  [[nodiscard]] std::string what() const override { return map_.what(); }

 private:
  PiecewiseFile file_;
  FlightMap map_;
  Write write_;
};

}  // namespace earshot::journal
