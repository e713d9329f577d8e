#include "sim/sonar/fan_file.hpp"

#include <limits>
#include <span>
#include <vector>

#include "sim/netcdf/conventions.hpp"
#include "sim/netcdf/writer.hpp"
#include "sim/sonar/field_attributes.hpp"
#include "sim/sonar/level_attributes.hpp"

namespace earshot::sonar {
namespace {

using netcdf::Attributes;
using netcdf::Type;
using netcdf::Writer;
using Shape = std::vector<std::string>;

void write_axis(Writer& file, const std::string& name, const std::vector<double>& values, const Attributes& attributes) {
  file.dimension(name, values.size());
  file.variable(name, Type::kDouble, {name}, attributes);
  file.write(name, values);
}

void write_floats(Writer& file, const std::string& name, const Shape& shape, const Attributes& attributes, std::span<const float> values) {
  file.variable(name, Type::kFloat, shape, attributes);
  file.attribute(name, "_FillValue", std::numeric_limits<double>::quiet_NaN());
  file.compress(name);
  file.write(name, values);
}

void write_axes(Writer& file, const Fan& fan) {
  write_axis(file, "bearing", bearings_deg(fan),
             {{"long_name", "bearing from the source, clockwise from grid north"}, {"units", "degree"}});
  write_axis(file, "range", ranges_m(fan), {{"long_name", "horizontal range from the source"}, {"units", "m"}});
  write_axis(file, "depth", fan.depth_m,
             {{"long_name", "depth of the receiver"}, {"units", "m"}, {"standard_name", "depth"}, {"positive", "down"}, {"axis", "Z"}});
}

void write_losses(Writer& file, const Fan& fan, const Detector& detector) {
  const Shape shape = {"bearing", "range", "depth"};
  write_transmission_loss(file, shape, "", fan.transmission_loss_db);
  write_floats(file, "detection_probability", shape, {{"long_name", "probability of detection"}, {"units", "1"}},
               detection_probabilities(fan, detector));
  write_floats(file, "sea_floor_depth", {"bearing", "range"},
               {{"long_name", "depth of the sea floor, 0 on land"}, {"standard_name", "sea_floor_depth_below_sea_surface"}, {"units", "m"}},
               fan.sea_floor_depth_m);
}

void write_detection(Writer& file, const Fan& fan, const Detector& detector) {
  write_scalar(file, "detection_threshold", netcdf::level_attributes("signal-to-noise ratio needed for detection", netcdf::kRatio),
               detector.detection_threshold.value);
  write_scalar(file, "fluctuation",
               netcdf::level_attributes("standard deviation of the signal-to-noise ratio, which is normal", netcdf::kRatio),
               detector.fluctuation.value);
  std::vector<float> assured;
  std::vector<float> furthest;
  for (std::size_t depth = 0; depth < fan.depth_m.size(); ++depth) {
    for (const DetectionRange& range : detection_ranges(fan, depth, detector)) {
      assured.push_back(static_cast<float>(range.assured_m));
      furthest.push_back(static_cast<float>(range.furthest_m));
    }
  }
  const Shape shape = {"depth", "bearing"};
  write_floats(file, "assured_detection_range", shape,
               {{"long_name", "range up to which the signal-to-noise ratio is never below the threshold"}, {"units", "m"}}, assured);
  write_floats(file, "furthest_detection_range", shape,
               {{"long_name", "greatest range at which the signal-to-noise ratio is at the threshold or above"},
                {"comment", "equal to the last range in the water where it is still heard there"},
                {"units", "m"}},
               furthest);
}

void write_map(Writer& file, const HorizontalMap& map, const ocean::Environment& environment) {
  write_axis(file, "north", map.north_m,
             {{"long_name", "northing in the local plane"}, {"standard_name", "projection_y_coordinate"}, {"units", "m"}, {"axis", "Y"}});
  write_axis(file, "east", map.east_m,
             {{"long_name", "easting in the local plane"}, {"standard_name", "projection_x_coordinate"}, {"units", "m"}, {"axis", "X"}});
  Attributes snr = snr_attributes();
  Attributes probability = {{"long_name", "probability of detection"}, {"units", "1"}};
  if (write_grid_mapping(file, environment)) {
    snr.emplace_back("grid_mapping", "local_plane");
    probability.emplace_back("grid_mapping", "local_plane");
  }
  write_floats(file, "map_snr", {"north", "east"}, snr, map.snr_db);
  write_floats(file, "map_detection_probability", {"north", "east"}, probability, map.detection_probability);
}

}  // namespace

void write_fan(const std::filesystem::path& path, const Fan& fan, const std::optional<HorizontalMap>& map,
               const ocean::Environment& environment, const ocean::Band& band, const Detector& detector, const std::string& history) {
  Writer file(path);
  write_provenance(file, "Sound around one source", environment, history);
  write_unmeasured(file, unmeasured_water(environment, fan.centre, fan.bearings, fan.max_range()));
  write_predicted_error(file, grid_of(fan));
  file.attribute("interpolation",
                 "each radial is a vertical plane of its own (N x 2D); the map is linear in dB along range, then between bearings");
  write_axes(file, fan);
  write_scene(file, environment, band);
  write_losses(file, fan, detector);
  write_detection(file, fan, detector);
  if (map) write_map(file, *map, environment);
  file.commit();
}

}  // namespace earshot::sonar
