#include "sim/sonar/field_attributes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "firmware/host/file/checksum_text.hpp"
#include "sim/netcdf/conventions.hpp"
#include "sim/ocean/charts/charts.hpp"
#include "sim/sonar/level_attributes.hpp"
#include "sim/sonar/sonar_field.hpp"

namespace earshot::sonar {

using netcdf::Type;
using netcdf::Writer;

std::string crc32_text(const ocean::Environment& environment) {
  return "0x" + host::crc32_text(environment.file_crc32);
}

void write_provenance(Writer& file, const std::string& title, const ocean::Environment& environment, const std::string& history) {
  file.attribute("Conventions", netcdf::kConventions);
  file.attribute("title", title + ": " + environment.name);
  file.attribute("source", "Earshot, one-way parabolic equation");
  file.attribute("history", history);
  file.attribute("environment_crc32", crc32_text(environment));
}

void write_unmeasured(Writer& file, const std::optional<ocean::UnmeasuredWater>& water) {
  if (water) file.attribute("unmeasured_water", to_string(*water));
}

void write_predicted_error(Writer& file, const std::optional<pe::MarchGrid>& grid) {
  if (grid && !std::isnan(grid->predicted_error_db)) file.attribute("predicted_error_db", grid->predicted_error_db);
}

void write_scalar(Writer& file, const std::string& name, const netcdf::Attributes& attributes, double value) {
  file.variable(name, Type::kDouble, {}, attributes);
  file.write(name, std::span(&value, 1));
}

void write_scalar(Writer& file, const std::string& name, const std::string& long_name, const std::string& units, double value) {
  write_scalar(file, name, {{"long_name", long_name}, {"units", units}}, value);
}

void write_transmission_loss(Writer& file, const std::vector<std::string>& dimensions, const std::string& coordinates,
                             std::span<const float> loss_db) {
  const std::string name = "transmission_loss";
  netcdf::Attributes attributes = transmission_loss_attributes();
  attributes.emplace_back(
      "comment", "rounded to 1/256 dB; signal-to-noise ratio at the hydrophone in dB = source_level - transmission_loss - noise_level");
  if (!coordinates.empty()) attributes.emplace_back("coordinates", coordinates);
  file.variable(name, Type::kFloat, dimensions, attributes);
  file.attribute(name, "_FillValue", std::numeric_limits<double>::quiet_NaN());
  file.attribute(name, "least_significant_digit", 2.0);  // the attribute that netCDF4-python and NCO write: good to 0.01
  file.compress(name);
  file.write(name, rounded_loss_db({loss_db.begin(), loss_db.end()}));
}

void write_scene(Writer& file, const ocean::Environment& environment, const ocean::Band& band) {
  const auto& source = environment.source;
  if (band.high > band.low) {
    const std::vector<double> frequency = frequencies_hz(band);
    file.dimension("frequency", frequency.size());
    file.variable("source_frequency", Type::kDouble, {"frequency"},
                  {{"long_name", "frequencies whose intensities are averaged"}, {"units", "Hz"}});
    file.write("source_frequency", frequency);
  } else {
    write_scalar(file, "source_frequency", "frequency of the source", "Hz", band.low.value);
  }
  write_scalar(file, "source_depth", "depth of the source", "m", source.depth.value);
  write_scalar(file, "source_north", "northing of the source in the local plane", "m", source.position.north.value);
  write_scalar(file, "source_east", "easting of the source in the local plane", "m", source.position.east.value);
  write_scalar(file, "source_level", source_level_attributes(), source.level.value);
  write_scalar(file, "noise_level", noise_level_attributes(), environment.noise_level.value);
}

bool write_grid_mapping(Writer& file, const ocean::Environment& environment) {
  if (environment.charts == nullptr) return false;
  const ocean::GeoPosition origin = environment.charts->grid.origin;
  file.variable("local_plane", Type::kInt32, {}, {{"grid_mapping_name", "azimuthal_equidistant"}});
  file.attribute("local_plane", "latitude_of_projection_origin", origin.latitude_deg);
  file.attribute("local_plane", "longitude_of_projection_origin", origin.longitude_deg);
  file.attribute("local_plane", "false_easting", 0.0);
  file.attribute("local_plane", "false_northing", 0.0);
  file.attribute("local_plane", "semi_major_axis", 6378137.0);  // WGS 84
  file.attribute("local_plane", "inverse_flattening", 298.257223563);
  return true;
}

}  // namespace earshot::sonar
