#include "sim/sonar/field_file.hpp"

#include <array>
#include <cstdio>
#include <span>
#include <string>
#include <vector>

#include "sim/netcdf/writer.hpp"

namespace earshot::sonar {
namespace {

using netcdf::Type;
using netcdf::Writer;

void write_provenance(Writer& file, const ocean::Environment& environment, const std::string& history) {
  std::array<char, 11> crc{};
  std::snprintf(crc.data(), crc.size(), "0x%08x", static_cast<unsigned>(environment.file_crc32));
  file.attribute("Conventions", "CF-1.8");
  file.attribute("title", "Sound field of one source: " + environment.name);
  file.attribute("source", "Earshot, split-step Pade parabolic equation");
  file.attribute("history", history);
  file.attribute("environment_crc32", crc.data());
}

void write_scalar(Writer& file, const std::string& name, const std::string& long_name, const std::string& units, double value) {
  file.variable(name, Type::kDouble, {}, {{"long_name", long_name}, {"units", units}});
  file.write(name, std::span(&value, 1));
}

void write_scalars(Writer& file, const ocean::Environment& environment) {
  const auto& source = environment.source;
  write_scalar(file, "source_frequency", "frequency of the source", "Hz", source.frequency.value);
  write_scalar(file, "source_depth", "depth of the source", "m", source.depth.value);
  write_scalar(file, "source_north", "northing of the source in the local plane", "m", source.position.north.value);
  write_scalar(file, "source_east", "easting of the source in the local plane", "m", source.position.east.value);
  write_scalar(file, "source_level", "source level, dB re 1 uPa at 1 m", "dB", source.level.value);
  write_scalar(file, "noise_level", "noise level in the detector's band, dB re 1 uPa", "dB", environment.noise_level.value);
  write_scalar(file, "sea_floor_depth", "depth of the sea floor at the source", "m", environment.seabed.depth.value);
}

void write_axes(Writer& file, const SonarField& field) {
  file.dimension("range", field.range_m.size());
  file.dimension("depth", field.depth_m.size());
  file.variable("range", Type::kDouble, {"range"}, {{"long_name", "horizontal range from the source"}, {"units", "m"}});
  file.variable("depth", Type::kDouble, {"depth"},
                {{"long_name", "depth of the receiver"}, {"units", "m"}, {"standard_name", "depth"}, {"positive", "down"}, {"axis", "Z"}});
  file.write("range", field.range_m);
  file.write("depth", field.depth_m);
}

void write_array(Writer& file, const std::string& name, const std::string& long_name, const DecibelArray& values) {
  file.variable(name, Type::kFloat, {"range", "depth"},
                {{"long_name", long_name}, {"units", "dB"}, {"coordinates", "source_frequency source_depth"}});
  file.compress(name);
  file.write(name, std::span(values.data(), static_cast<std::size_t>(values.size())));
}

}  // namespace

void write_field(const std::filesystem::path& path, const SonarField& field, const ocean::Environment& environment,
                 const std::string& history) {
  Writer file(path);
  write_provenance(file, environment, history);
  write_axes(file, field);
  write_scalars(file, environment);
  write_array(file, "transmission_loss", "transmission loss, dB re 1 m", field.transmission_loss_db);
  write_array(file, "snr", "signal-to-noise ratio at the hydrophone", field.snr_db);
  file.commit();
}

}  // namespace earshot::sonar
