#include "hil/nodes/vehicle/track_file.hpp"

#include <cerrno>
#include <charconv>
#include <string>
#include <system_error>

#include "firmware/host/text/numbers.hpp"

namespace earshot::hil {
namespace {

constexpr Duration kEvery = Duration::seconds(1);

/// The next number of a line, which a comma or the line's end follows.
bool take_number(std::string_view& line, double& number) {
  const std::from_chars_result read = std::from_chars(line.data(), line.data() + line.size(), number);
  if (read.ec != std::errc{}) return false;
  line.remove_prefix(static_cast<std::size_t>(read.ptr - line.data()));
  if (line.starts_with(',')) line.remove_prefix(1);
  return true;
}

}  // namespace

TrackFile::TrackFile(const std::filesystem::path& path) : file_(path, std::ios::app) {
  if (!file_) throw std::system_error(errno, std::generic_category(), path.string());
  if (file_.tellp() == 0) file_ << kTrackHeader << "\n" << std::flush;
}

void TrackFile::note(Time now, Time host, const vehicle::State& state) {
  if (last_ && now - *last_ < kEvery) return;
  last_ = now;
  file_ << host::decimals((host - Time{}).to_seconds(), 6) << "," << host::decimals(state.position.north.value, 3) << ","
        << host::decimals(state.position.east.value, 3) << "," << host::decimals(state.depth.value, 3) << "\n"
        << std::flush;
}

std::vector<TrackPlace> read_track(const std::filesystem::path& path) {
  std::vector<TrackPlace> track;
  std::ifstream file(path);
  for (std::string line; std::getline(file, line) && !file.eof();) {
    std::string_view rest = line;
    double host_s = 0.0;
    TrackPlace place;
    if (!take_number(rest, host_s) || !take_number(rest, place.position.north.value) || !take_number(rest, place.position.east.value) ||
        !take_number(rest, place.depth.value) || !rest.empty())
      continue;  // the header, or a line that a SIGKILL cut and another process wrote on
    place.host = Time{static_cast<std::int64_t>(host_s * 1e6)};
    track.push_back(place);
  }
  return track;
}

}  // namespace earshot::hil
