#include "sim/sonar/field_file.hpp"

#include <netcdf.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <stdexcept>
#include <string_view>
#include <vector>

namespace earshot::sonar {
namespace {

void check(int status) {
  if (status != NC_NOERR) throw std::runtime_error(nc_strerror(status));
}

/// An open NetCDF file under a temporary name; unless published, it disappears.
class TemporaryFile {
 public:
  explicit TemporaryFile(const std::filesystem::path& target) : target_(target), path_(target) {
    path_ += ".part" + std::to_string(getpid());
    check(nc_create(path_.c_str(), NC_NETCDF4 | NC_CLOBBER, &id_));
    open_ = true;
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  ~TemporaryFile() {
    if (open_) nc_abort(id_);
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);  // gone already when it was published
  }

  void publish() {
    open_ = false;
    check(nc_close(id_));
    std::filesystem::rename(path_, target_);
  }

  void text(int variable, const char* name, std::string_view value) const {
    check(nc_put_att_text(id_, variable, name, value.size(), value.data()));
  }

  int variable(const char* name, nc_type type, const std::vector<int>& dimensions, std::string_view long_name,
               std::string_view units) const {
    int variable = 0;
    check(nc_def_var(id_, name, type, static_cast<int>(dimensions.size()), dimensions.data(), &variable));
    text(variable, "long_name", long_name);
    text(variable, "units", units);
    return variable;
  }

  void scalar(const char* name, std::string_view long_name, std::string_view units, double value) const {
    check(nc_put_var_double(id_, variable(name, NC_DOUBLE, {}, long_name, units), &value));
  }

  [[nodiscard]] int id() const { return id_; }

 private:
  std::filesystem::path target_;
  std::filesystem::path path_;
  int id_ = 0;
  bool open_ = false;
};

void write_provenance(const TemporaryFile& file, const ocean::Environment& environment, const std::string& history) {
  std::array<char, 11> crc{};
  std::snprintf(crc.data(), crc.size(), "0x%08x", static_cast<unsigned>(environment.file_crc32));
  file.text(NC_GLOBAL, "Conventions", "CF-1.8");
  file.text(NC_GLOBAL, "title", "Sound field of one source: " + environment.name);
  file.text(NC_GLOBAL, "source", "Earshot, split-step Pade parabolic equation");
  file.text(NC_GLOBAL, "history", history);
  file.text(NC_GLOBAL, "environment_crc32", crc.data());
}

void write_scalars(const TemporaryFile& file, const ocean::Environment& environment) {
  const auto& source = environment.source;
  file.scalar("source_frequency", "frequency of the source", "Hz", source.frequency.value);
  file.scalar("source_depth", "depth of the source", "m", source.depth.value);
  file.scalar("source_north", "northing of the source in the local plane", "m", source.position.north.value);
  file.scalar("source_east", "easting of the source in the local plane", "m", source.position.east.value);
  file.scalar("source_level", "source level, dB re 1 uPa at 1 m", "dB", source.level.value);
  file.scalar("noise_level", "noise level in the detector's band, dB re 1 uPa", "dB", environment.noise_level.value);
  file.scalar("sea_floor_depth", "depth of the sea floor", "m", environment.seabed.depth.value);
}

void write_axis(const TemporaryFile& file, int variable, const std::vector<double>& values) {
  check(nc_put_var_double(file.id(), variable, values.data()));
}

void write_array(const TemporaryFile& file, const char* name, const std::vector<int>& dimensions, std::string_view long_name,
                 const DecibelArray& values) {
  const int variable = file.variable(name, NC_FLOAT, dimensions, long_name, "dB");
  check(nc_def_var_deflate(file.id(), variable, NC_SHUFFLE, 1, 1));
  file.text(variable, "coordinates", "source_frequency source_depth");
  check(nc_put_var_float(file.id(), variable, values.data()));
}

void write_everything(TemporaryFile& file, const SonarField& field, const ocean::Environment& environment, const std::string& history) {
  write_provenance(file, environment, history);
  std::vector<int> dimensions(2);
  check(nc_def_dim(file.id(), "range", field.range_m.size(), &dimensions[0]));
  check(nc_def_dim(file.id(), "depth", field.depth_m.size(), &dimensions[1]));
  const int range = file.variable("range", NC_DOUBLE, {dimensions[0]}, "horizontal range from the source", "m");
  const int depth = file.variable("depth", NC_DOUBLE, {dimensions[1]}, "depth of the receiver", "m");
  file.text(depth, "standard_name", "depth");
  file.text(depth, "positive", "down");
  file.text(depth, "axis", "Z");
  write_axis(file, range, field.range_m);
  write_axis(file, depth, field.depth_m);
  write_scalars(file, environment);
  write_array(file, "transmission_loss", dimensions, "transmission loss, dB re 1 m", field.transmission_loss_db);
  write_array(file, "snr", dimensions, "signal-to-noise ratio at the hydrophone", field.snr_db);
  file.publish();
}

}  // namespace

void write_field(const std::filesystem::path& path, const SonarField& field, const ocean::Environment& environment,
                 const std::string& history) {
  try {
    TemporaryFile file(path);
    write_everything(file, field, environment, history);
  } catch (const std::exception& e) {
    throw std::runtime_error(path.string() + ": cannot be written: " + e.what());
  }
}

}  // namespace earshot::sonar
