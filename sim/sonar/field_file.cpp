#include "sim/sonar/field_file.hpp"

#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "sim/netcdf/writer.hpp"
#include "sim/sonar/field_attributes.hpp"
#include "sim/sonar/level_attributes.hpp"

namespace earshot::sonar {
namespace {

using netcdf::Type;
using netcdf::Writer;

void write_axes(Writer& file, const SonarField& field) {
  file.dimension("range", field.range_m.size());
  file.dimension("depth", field.depth_m.size());
  file.variable("range", Type::kDouble, {"range"}, {{"long_name", "horizontal range from the source"}, {"units", "m"}});
  file.variable("depth", Type::kDouble, {"depth"},
                {{"long_name", "depth of the receiver"}, {"units", "m"}, {"standard_name", "depth"}, {"positive", "down"}, {"axis", "Z"}});
  file.write("range", field.range_m);
  file.write("depth", field.depth_m);
}

void write_sea_floor(Writer& file, const SonarField& field) {
  file.variable(
      "sea_floor_depth", Type::kFloat, {"range"},
      {{"long_name", "depth of the sea floor, 0 on land"}, {"standard_name", "sea_floor_depth_below_sea_surface"}, {"units", "m"}});
  file.write("sea_floor_depth", field.sea_floor_depth_m);
}

void write_snr(Writer& file, const SonarField& field) {
  netcdf::Attributes attributes = snr_attributes();
  attributes.emplace_back("coordinates", "source_depth bearing");
  file.variable("snr", Type::kFloat, {"range", "depth"}, attributes);
  file.attribute("snr", "_FillValue", std::numeric_limits<double>::quiet_NaN());
  file.compress("snr");
  file.write("snr", rounded_snr_db(field));
}

}  // namespace

void write_field(const std::filesystem::path& path, const SonarField& field, const ocean::Environment& environment, Radians bearing,
                 const ocean::Band& band, const std::string& history) {
  Writer file(path);
  write_provenance(file, "Sound field of one source", environment, history);
  write_unmeasured(file, field.unmeasured);
  write_predicted_error(file, field.grid);
  write_axes(file, field);
  write_scene(file, environment, band);
  write_scalar(file, "bearing", "bearing of the radial from the source, clockwise from grid north", "degree",
               bearing.value * 180.0 / std::numbers::pi);
  write_sea_floor(file, field);
  write_transmission_loss(file, {"range", "depth"}, "source_depth bearing", field.transmission_loss_db);
  write_snr(file, field);
  file.commit();
}

}  // namespace earshot::sonar
