// sim/ocean/charts/geography.hpp by _geography.so, which is loaded when an ocean first asks where it is on the globe. It stands beside this
// module.
#include "sim/ocean/charts/geography.hpp"

#include <dlfcn.h>

#include <array>
#include <filesystem>
#include <string>

#include "policy/python/late/geography_library.hpp"
#include "policy/python/late/late_library.hpp"

namespace earshot::ocean {
namespace {

std::string beside_this_module(const char* name) {
  Dl_info module{};
  static const int here = 0;
  (void)dladdr(&here, &module);
  return std::filesystem::path(module.dli_fname).replace_filename(name);
}

template <class Declared>
Declared* geography(const char* name) {
  static const std::string path = beside_this_module("_geography.so");
  static const std::array<const char*, 1> names{path.c_str()};
  return python::late<Declared>(
      python::LateLibrary(names, "latitudes and longitudes cannot be read: the C++ library is not installed: sudo apt install libstdc++6"),
      name);
}

using Degrees = std::array<double, 2>;

Degrees degrees_of(GeoPosition position) {
  return {position.latitude_deg, position.longitude_deg};
}

}  // namespace

NorthEast LocalGrid::to_plane(GeoPosition position) const {
  static auto* const function = geography<decltype(earshot_to_plane)>("earshot_to_plane");
  std::array<double, 2> plane{};
  function(degrees_of(origin).data(), degrees_of(position).data(), plane.data());
  return {.north = Meters{plane[0]}, .east = Meters{plane[1]}};
}

GeoPosition LocalGrid::to_geographic(NorthEast position) const {
  static auto* const function = geography<decltype(earshot_to_geographic)>("earshot_to_geographic");
  const std::array<double, 2> plane{position.north.value, position.east.value};
  Degrees degrees{};
  function(degrees_of(origin).data(), plane.data(), degrees.data());
  return {.latitude_deg = degrees[0], .longitude_deg = degrees[1]};
}

RangeAndAzimuth geodesic_between(GeoPosition from, GeoPosition to) {
  static auto* const function = geography<decltype(earshot_geodesic)>("earshot_geodesic");
  RangeAndAzimuth result;
  function(degrees_of(from).data(), degrees_of(to).data(), &result.range.value, &result.azimuth.value);
  return result;
}

std::vector<GeoPosition> geodesic_radial(GeoPosition from, Radians azimuth, std::span<const double> range_m) {
  static auto* const function = geography<decltype(earshot_radial)>("earshot_radial");
  std::vector<double> degrees(2 * range_m.size());
  function(degrees_of(from).data(), azimuth.value, range_m.data(), range_m.size(), degrees.data());
  std::vector<GeoPosition> positions;
  for (std::size_t i = 0; i < range_m.size(); ++i)
    positions.push_back({.latitude_deg = degrees[2 * i], .longitude_deg = degrees[2 * i + 1]});
  return positions;
}

}  // namespace earshot::ocean
