#include "sim/ocean/file/acoustics_toolbox/env_file.hpp"

#include <array>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "firmware/host/file/file_checksum.hpp"
#include "firmware/host/file/printable.hpp"
#include "firmware/host/text/numbers.hpp"
#include "sim/ocean/file/acoustics_toolbox/media.hpp"
#include "sim/ocean/file/acoustics_toolbox/range_files.hpp"
#include "sim/ocean/file/acoustics_toolbox/receivers.hpp"
#include "sim/ocean/file/acoustics_toolbox/top_options.hpp"
#include "sim/ocean/file/list_directed/list_reader.hpp"
#include "sim/ocean/section_along.hpp"

namespace earshot::ocean::acoustics_toolbox {
namespace {

using host::Range;

constexpr std::size_t kMostMedia = 500;

/// The first line that is not blank. An empty title stands in quotes, and the file's name in its place.
std::string read_title(ListReader& file, const std::filesystem::path& path) {
  file.skip_blanks();
  const std::string title = file.line("title");
  return host::printable(title.empty() ? path.stem().string() : title);
}

void require_smooth(const ListReader& file, double roughness_m) {
  if (roughness_m != 0.0) throw file.error("roughness in m", roughness_m, "must be 0: boundaries are smooth");
}

std::vector<Medium> read_media(ListReader& file, FluidLines& lines, std::size_t count) {
  std::vector<Medium> media;
  double top_m = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    std::array<double, 3> head{0.0, 0.0, 0.0};  // points of a mesh of KRAKEN's, roughness, bottom
    if (file.numbers(head, "mesh, roughness and bottom of a medium") < head.size())
      throw file.error("mesh, roughness and bottom of a medium", "less than 3 numbers", "must be 3");
    require_smooth(file, head[1]);
    file.require("bottom of a medium in m", head[2], Range::above_up_to(top_m, 12'000.0));
    media.push_back(lines.medium(top_m, head[2]));
    top_m = media.back().back().depth_m;
  }
  return media;
}

/// @return whether there is a bathymetry file
bool read_bottom_options(ListReader& file) {
  constexpr const char* kWhat = "bottom options";
  std::array<double, 1> roughness_m{0.0};
  std::string options = file.text_and_numbers(kWhat, roughness_m);
  options.resize(std::max<std::size_t>(options.size(), 2), ' ');
  if (options[0] != 'A') throw file.error(kWhat, options, "the first letter must be A, a half-space");
  if (std::string(" -_~*").find(options[1]) == std::string::npos)
    throw file.error(kWhat, options, "the second letter must be a blank, - or _, or ~ or * where there is a .bty file");
  require_smooth(file, roughness_m[0]);
  return options[1] == '~' || options[1] == '*';
}

void add_file(Environment& environment, std::filesystem::path path) {
  environment.file_crc32 = host::crc32_of_file(path, environment.file_crc32);
  environment.files.push_back(std::move(path));
}

/// @param path  NAME.env, or NAME.ENV, beside which the other file's name is in capitals too
std::filesystem::path beside(std::filesystem::path path, const char* suffix, const char* in_capitals) {
  return path.replace_extension(path.extension() == ".ENV" ? in_capitals : suffix);
}

void take_water(Environment& environment, const std::filesystem::path& path, const TopOptions& options, const TabulatedProfile& profile) {
  environment.water = profile;
  if (options.interpolation != Interpolation::kRangesAndDepths) return;
  environment.water_stations = read_water(beside(path, ".ssp", ".SSP"), profile.depth_m);
  environment.water = environment.water_stations.front().profile;
  add_file(environment, beside(path, ".ssp", ".SSP"));
}

}  // namespace

RadialCase load_env(const std::filesystem::path& path) {
  ListReader file(path);
  RadialCase result;
  Environment& environment = result.environment;
  environment.name = read_title(file, path);
  add_file(environment, path);
  environment.source.frequency = Hertz{file.number("frequency in Hz", Range::between(1.0, 10'000.0))};
  const std::size_t media_count = file.count("number of media", 1, kMostMedia);
  const TopOptions options = read_top_options(file);
  FluidLines lines(file, options, environment.source.frequency);
  const std::vector<Medium> media = read_media(file, lines, media_count);
  const bool has_bathymetry = read_bottom_options(file);
  if (has_bathymetry && media_count > 1) throw file.error("bottom options", "~", "a .bty file must have one medium above it, the water");
  const FluidPoint half_space = lines.half_space();
  const Fluids fluids = fluids_of(file, media, half_space, options, environment.source.frequency);
  environment.absorption_db_per_km = fluids.absorption_db_per_km;
  environment.seabed = {.depth = Meters{media.front().back().depth_m}, .layers = fluids.sediment};
  take_water(environment, path, options, fluids.water);
  if (has_bathymetry) {
    Bathymetry bathymetry = read_bathymetry(beside(path, ".bty", ".BTY"), environment.seabed.depth, options, environment.source.frequency,
                                            fluids.water_density_g_per_cm3);
    environment.sea_floor_stations = std::move(bathymetry.sea_floor);
    environment.sediment_stations = std::move(bathymetry.sediment);
    environment.seabed.depth = environment.sea_floor_stations.front().depth;
    if (!environment.sediment_stations.empty()) environment.seabed.layers = environment.sediment_stations.front().layers;
    add_file(environment, beside(path, ".bty", ".BTY"));
  }
  Receivers receivers = read_receivers(file, environment.seabed.depth);
  environment.source.depth = Meters{receivers.source_depth_m.front()};
  result.source_depth_m = std::move(receivers.source_depth_m);
  result.receiver_depth_m = std::move(receivers.depth_m);
  result.receiver_range_m = std::move(receivers.range_m);
  result.max_range = receivers.max_range;
  return result;
}

}  // namespace earshot::ocean::acoustics_toolbox
