#include "policy/report/document/flight_parts.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "firmware/messages/dictionary/mission_words.hpp"
#include "firmware/messages/dictionary/safety_words.hpp"
#include "policy/report/document/json_values.hpp"
#include "policy/report/page/page_template.hpp"

namespace earshot::report {
namespace {

using nlohmann::ordered_json;

ordered_json polygon_value(std::span<const NorthEast> polygon) {
  ordered_json corners = ordered_json::array();
  for (const NorthEast& corner : polygon) corners.push_back(place_value(corner));
  return corners;
}

/// So many neighbours make one, that no more than `most` are left.
std::size_t stride_to(std::size_t count, std::size_t most) {
  return std::max<std::size_t>(1, (count + most - 1) / most);
}

/// The mean intensity of rows [row, row + rows) and columns [column, column + columns) of a spectrogram, dB.
double mean_level_db(const SpectrogramTable& table, std::size_t row, std::size_t rows, std::size_t column, std::size_t columns) {
  const std::size_t width = table.frequency_hz.size();
  double sum = 0.0;
  std::size_t count = 0;
  for (std::size_t i = row; i < std::min(row + rows, table.time_s.size()); ++i) {
    for (std::size_t j = column; j < std::min(column + columns, width); ++j, ++count)
      sum += std::pow(10.0, table.level_db[i * width + j] / 10.0);
  }
  return 10.0 * std::log10(sum / static_cast<double>(count));
}

/// The mean of so many neighbours.
std::vector<double> thinned(const std::vector<double>& values, std::size_t stride) {
  std::vector<double> means;
  for (std::size_t i = 0; i < values.size(); i += stride) {
    const std::size_t count = std::min(stride, values.size() - i);
    double sum = 0.0;
    for (std::size_t k = 0; k < count; ++k) sum += values[i + k];
    means.push_back(sum / static_cast<double>(count));
  }
  return means;
}

ordered_json rounded_all(const std::vector<double>& values, int decimals) {
  ordered_json all = ordered_json::array();
  for (const double value : values) all.push_back(rounded(value, decimals));
  return all;
}

}  // namespace

ordered_json mission_value(const config::Mission& mission, const nlohmann::json& summary) {
  const Rectangle& area = mission.operating_area;
  const config::Safety& safety = mission.safety;
  const config::Fence fence = safety.fence.value_or(config::Fence{});
  ordered_json zones = ordered_json::array();
  for (const config::Polygon& zone : safety.no_surface) zones.push_back(polygon_value(zone.span()));
  const bool has_origin = summary.is_object() && summary.contains("origin") && summary.at("origin").is_object();
  return {{"area",
           {{"south_m", rounded(area.south_west.north.value, 1)},
            {"west_m", rounded(area.south_west.east.value, 1)},
            {"north_m", rounded(area.north_east.north.value, 1)},
            {"east_m", rounded(area.north_east.east.value, 1)}}},
          {"origin", has_origin ? ordered_json(summary.at("origin")) : ordered_json()},
          {"fence_inside", polygon_value(fence.inside.span())},
          {"fence_save", polygon_value(fence.save.span())},
          {"fence_halt", polygon_value(fence.halt.span())},
          {"no_surface_zones", zones},
          {"safe_point", safety.safe_point ? place_value(*safety.safe_point) : ordered_json()},
          {"detection_threshold_db", rounded(mission.detection_threshold.value, 2)},
          {"source_frequency_hz", rounded(mission.source_frequency.value, 2)},
          {"search_depth_m", rounded(mission.search_depth.value, 1)},
          {"max_depth_m", rounded(mission.max_depth.value, 1)},
          {"search_speed_mps", rounded(mission.search_speed.value, 2)},
          {"step_length_m", rounded(mission.step_length.value, 1)},
          {"max_steps", mission.max_steps}};
}

ordered_json health_value(const messages::Health& health) {
  const messages::Counters& c = health.counters;
  const std::pair<const char*, std::uint64_t> counters[] = {{"fixes refused", c.navigation_refused},
                                                            {"SNR measurements refused", c.snr_refused},
                                                            {"status reports refused", c.status_refused},
                                                            {"bearings refused", c.bearings_refused},
                                                            {"bearings of a second sender", c.bearings_of_others},
                                                            {"orders refused", c.commands_refused},
                                                            {"way-points and set-points limited", c.setpoints_limited}};
  ordered_json counted = ordered_json::array();
  for (const auto& [name, value] : counters) counted.push_back({{"name", name}, {"value", value}});
  ordered_json ports = ordered_json::array();
  for (const messages::PortReport& port : health.ports)
    ports.push_back({{"port", port.port},
                     {"link_up", port.link_up},
                     {"received", port.received},
                     {"lost", port.lost},
                     {"malformed", port.malformed},
                     {"unsent", port.unsent}});
  return {{"state", messages::name_of(health.state)},
          {"end_reason", messages::to_string(health.end_reason)},
          {"response", messages::name_of(health.response)},
          {"authority", messages::name_of(health.authority)},
          {"steps_taken", health.steps_taken},
          {"counters", counted},
          {"ports", ports}};
}

ordered_json truth_value(const FlightFiles& files) {
  if (files.summary.is_null()) return nullptr;
  constexpr std::size_t kMostRanges = 500;
  const std::size_t stride = stride_to(files.snr.size(), kMostRanges);
  ordered_json ranges = ordered_json::array();
  ordered_json levels = ordered_json::array();
  for (std::size_t i = 0; i < files.snr.size(); i += stride) {
    ranges.push_back(rounded(files.snr[i].range_m, 1));
    levels.push_back(rounded(files.snr[i].snr_db, 2));
  }
  return {{"source", place_value(place_in(files.summary.at("source")))},
          {"source_moves", false},  // no simulator moves it
          {"snr_of_range", {{"range_m", ranges}, {"snr_db", levels}}}};
}

ordered_json sound_value(const HeardSound& sound, double began_s) {
  if (!sound.is_there()) return nullptr;
  constexpr std::size_t kMostTimes = 1'500;
  constexpr std::size_t kMostFrequencies = 256;
  const SpectrogramTable& table = sound.spectrogram;
  const std::size_t rows = stride_to(table.time_s.size(), kMostTimes);
  const std::size_t columns = stride_to(table.frequency_hz.size(), kMostFrequencies);
  std::vector<double> level_db;
  for (std::size_t i = 0; i < table.time_s.size(); i += rows) {
    for (std::size_t j = 0; j < table.frequency_hz.size(); j += columns) level_db.push_back(mean_level_db(table, i, rows, j, columns));
  }
  const auto [least, most] = std::ranges::minmax(level_db);
  const double span = most > least ? most - least : 1.0;
  std::vector<std::uint8_t> cells;
  cells.reserve(level_db.size());
  for (const double level : level_db) cells.push_back(static_cast<std::uint8_t>(std::lround(255.0 * (level - least) / span)));
  std::vector<double> times = thinned(table.time_s, rows);
  for (double& time : times) time -= began_s;
  constexpr std::size_t kMostMeasurements = 2'000;
  ordered_json measured_s = ordered_json::array();
  ordered_json modelled_db = ordered_json::array();
  for (std::size_t i = 0; i < sound.measurements.size(); i += stride_to(sound.measurements.size(), kMostMeasurements)) {
    const HeardRow& row = sound.measurements[i];
    measured_s.push_back(rounded(row.time_s - began_s, 1));
    modelled_db.push_back(row.modelled_too_faint ? ordered_json() : rounded(row.modelled_snr_db, 2));
  }
  return {{"frequency_hz", rounded_all(thinned(table.frequency_hz, columns), 2)},
          {"time_s", rounded_all(times, 1)},
          {"level_db_re_1upa2_per_hz", {{"least", rounded(least, 2)}, {"most", rounded(most, 2)}, {"cells", base64(cells)}}},
          {"modelled", {{"time_s", measured_s}, {"snr_db", modelled_db}}}};
}

}  // namespace earshot::report
