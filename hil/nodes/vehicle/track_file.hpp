#pragma once

#include <filesystem>
#include <fstream>
#include <optional>
#include <string_view>
#include <vector>

#include "firmware/core/geometry.hpp"
#include "firmware/core/time.hpp"
#include "firmware/core/units.hpp"
#include "sim/vehicle/vehicle.hpp"

namespace earshot::hil {

/// Where an emulated vehicle truly was.
struct TrackPlace {
  Time host;  ///< ScaledClock::host_now(), which every process on this host reads alike
  NorthEast position;
  Meters depth;
};

inline constexpr std::string_view kTrackHeader = "host_s,north_m,east_m,depth_m";

/// A track in a file (CSV), one place for every second at sea. Each line is with the kernel when it is written, so that a SIGKILL takes
/// none.
class TrackFile {
 public:
  /// Goes on behind what the file holds. @throws std::system_error
  explicit TrackFile(const std::filesystem::path& path);
  /// @param now  of the vehicle's time
  void note(Time now, Time host, const vehicle::State& state);

 private:
  std::ofstream file_;
  std::optional<Time> last_;
};

/// A last line without its end is left out. @return nothing of a file that is not there
[[nodiscard]] std::vector<TrackPlace> read_track(const std::filesystem::path& path);

}  // namespace earshot::hil
