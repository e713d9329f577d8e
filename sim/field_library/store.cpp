#include "sim/field_library/store.hpp"

#include <limits>
#include <string>
#include <utility>

#include "firmware/host/file/checksum_text.hpp"
#include "sim/netcdf/conventions.hpp"
#include "sim/sonar/field_attributes.hpp"
#include "sim/sonar/level_attributes.hpp"

namespace earshot::field_library {
namespace {

using namespace std::chrono_literals;
using netcdf::Type;

netcdf::VariableLayout scalar(const std::string& name, netcdf::Attributes attributes) {
  return {.name = name, .type = Type::kDouble, .dimensions = {}, .attributes = std::move(attributes)};
}

netcdf::Attributes loss_attributes() {
  netcdf::Attributes attributes = sonar::transmission_loss_attributes();
  attributes.emplace_back("coordinates", "position_north position_east");
  return attributes;
}

netcdf::Attributes attributes_of(const LibraryPlan& plan) {
  netcdf::Attributes attributes = {{"Conventions", netcdf::kConventions},
                                   {"title", "Sound fields of a region: " + plan.name},
                                   {"source", "Earshot, one-way parabolic equation"},
                                   {"history", "earshot field --library"},
                                   {"environment", plan.environment.name},
                                   {"environment_crc32", sonar::crc32_text(plan.environment)},
                                   {"library_crc32", "0x" + host::crc32_text(plan.file_crc32)},
                                   {"interpolation", "each radial is a vertical plane of its own (N x 2D)"}};
  if (const auto water = unmeasured_water(plan)) attributes.emplace_back("unmeasured_water", to_string(*water));
  return attributes;
}

netcdf::Layout layout_of(const LibraryPlan& plan) {
  const bool around_source = plan.centre == Centre::kSource;
  const std::string middle = around_source ? "source" : "hydrophone";
  const std::string around = around_source ? "receiver" : "source";
  return {.attributes = attributes_of(plan),
          .dimensions = {{"position", plan.positions.size()},
                         {"bearing", plan.fan.bearings},
                         {"range", plan.fan.radial.ranges},
                         {"depth", plan.fan.radial.depth_m.size()},
                         {"frequency", sonar::frequencies_hz(plan.fan.radial.band).size()}},
          .variables = {
              {"position_north", Type::kDouble, {"position"}, {{"long_name", "northing of the " + middle}, {"units", "m"}}},
              {"position_east", Type::kDouble, {"position"}, {{"long_name", "easting of the " + middle}, {"units", "m"}}},
              {"bearing",
               Type::kDouble,
               {"bearing"},
               {{"long_name", "bearing from the " + middle + ", clockwise from grid north"}, {"units", "degree"}}},
              {"range", Type::kDouble, {"range"}, {{"long_name", "horizontal range from the " + middle}, {"units", "m"}}},
              {"depth",
               Type::kDouble,
               {"depth"},
               {{"long_name", "depth of the " + around}, {"units", "m"}, {"standard_name", "depth"}, {"positive", "down"}, {"axis", "Z"}}},
              {"frequency",
               Type::kDouble,
               {"frequency"},
               {{"long_name", "frequency; intensity is averaged where there are several"}, {"units", "Hz"}}},
              scalar("position_depth", {{"long_name", "depth of the " + middle}, {"units", "m"}}),
              scalar("source_level", sonar::source_level_attributes()),
              scalar("noise_level", sonar::noise_level_attributes()),
              {"position_state",
               Type::kInt32,
               {"position"},
               {{"long_name", "whether the field of a position is there"}, {"flag_meanings", "to_do done no_water"}},
               0.0,
               {0.0, 1.0, 2.0}},
              {"transmission_loss",
               Type::kFloat,
               {"position", "bearing", "range", "depth"},
               loss_attributes(),
               std::numeric_limits<double>::quiet_NaN()}}};
}

void write_axes(netcdf::ResumableFile& file, const LibraryPlan& plan) {
  const sonar::FanPlan& fan = plan.fan;
  const auto write = [&file](const std::string& name, const std::vector<double>& values) {
    file.write(name, {.start = {0}, .count = {values.size()}}, values);
  };
  const auto write_one = [&file](const std::string& name, double value) {
    file.write(name, {.start = {}, .count = {}}, std::span<const double>(&value, 1));
  };
  std::vector<double> north, east, bearing, range;
  for (const NorthEast& p : plan.positions) north.push_back(p.north.value), east.push_back(p.east.value);
  for (std::size_t j = 0; j < fan.bearings; ++j) bearing.push_back(360.0 * static_cast<double>(j) / static_cast<double>(fan.bearings));
  for (std::size_t i = 0; i < fan.radial.ranges; ++i) range.push_back(static_cast<double>(i + 1) * fan.radial.range_step.value);
  write("position_north", north);
  write("position_east", east);
  write("bearing", bearing);
  write("range", range);
  write("depth", fan.radial.depth_m);
  write("frequency", sonar::frequencies_hz(fan.radial.band));
  write_one("position_depth", fan.radial.source_depth.value);
  write_one("source_level", plan.environment.source.level.value);
  write_one("noise_level", plan.environment.noise_level.value);
}

}  // namespace

LibraryStore::LibraryStore(const std::filesystem::path& path, const LibraryPlan& plan)
    : file_(path, layout_of(plan)),
      states_(file_.read("position_state")),
      fan_shape_{1, plan.fan.bearings, plan.fan.radial.ranges, plan.fan.radial.depth_m.size()} {
  write_axes(file_, plan);
}

LibraryStore::~LibraryStore() {
  if (unmarked_.empty()) return;
  try {
    write_marks();
  } catch (const netcdf::FileError&) {  // then they will be computed again
  }
}

bool LibraryStore::is_finished(const std::filesystem::path& path, const LibraryPlan& plan) {
  return netcdf::ResumableFile::is_finished(path, layout_of(plan));
}

void LibraryStore::write(std::size_t position, std::span<const float> transmission_loss_db) {
  file_.write("transmission_loss", {.start = {position, 0, 0, 0}, .count = fan_shape_}, transmission_loss_db);
  unmarked_.push_back(position);
  if (std::chrono::steady_clock::now() - last_flush_ > 1s) write_marks();
}

void LibraryStore::mark(std::size_t position, PositionState state) {
  states_[position] = static_cast<double>(state);
  file_.write("position_state", {.start = {position}, .count = {1}}, std::span<const double>(&states_[position], 1));
}

void LibraryStore::write_marks() {
  file_.flush();  // the fields before their marks
  for (const std::size_t position : std::exchange(unmarked_, {})) mark(position, PositionState::kDone);
  file_.flush();
  last_flush_ = std::chrono::steady_clock::now();
}

void LibraryStore::commit() {
  write_marks();
  file_.commit();
}

}  // namespace earshot::field_library
