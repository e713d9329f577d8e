#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "sim/netcdf/writer.hpp"

namespace earshot::tests {

/// A small NetCDF file in GEBCO's layout; tests change one thing of it.
struct GebcoFile {
  std::vector<double> latitude_deg;
  std::vector<double> longitude_deg;
  std::function<double(double latitude_deg, double longitude_deg)> elevation_m;
  std::string variable = "elevation";
  std::string units = "m";
  std::string latitude_units = "degrees_north";
  bool transposed = false;

  void write(const std::filesystem::path& path) const {
    netcdf::Writer file(path);
    file.dimension("lat", latitude_deg.size());
    file.dimension("lon", longitude_deg.size());
    file.variable("lat", netcdf::Type::kDouble, {"lat"}, {{"units", latitude_units}});
    file.variable("lon", netcdf::Type::kDouble, {"lon"}, {{"units", "degrees_east"}});
    const std::vector<std::string> shape = transposed ? std::vector<std::string>{"lon", "lat"} : std::vector<std::string>{"lat", "lon"};
    file.variable(variable, netcdf::Type::kInt16, shape, {{"units", units}});
    file.write("lat", latitude_deg);
    file.write("lon", longitude_deg);
    std::vector<double> values;
    for (const double lat : latitude_deg) {
      for (const double lon : longitude_deg) values.push_back(elevation_m(lat, lon));
    }
    file.write(variable, values);
    file.commit();
  }
};

/// A small NetCDF file in the layout of the World Ocean Atlas with both t_an and s_an. A value above `kFill` is absent.
struct AtlasFile {
  static constexpr double kFill = 9.96921e36;
  std::vector<double> depth_m;
  std::vector<double> latitude_deg;
  std::vector<double> longitude_deg;
  std::function<double(double depth_m, double latitude_deg, double longitude_deg)> temperature_c;
  std::function<double(double depth_m, double latitude_deg, double longitude_deg)> salinity_psu;
  std::string temperature_units = "degrees_celsius";
  bool with_time = true;
  std::size_t times = 1;  ///< the same at each

  void write(const std::filesystem::path& path) const {
    netcdf::Writer file(path);
    file.dimension("time", times);
    file.dimension("depth", depth_m.size());
    file.dimension("lat", latitude_deg.size());
    file.dimension("lon", longitude_deg.size());
    file.variable("depth", netcdf::Type::kFloat, {"depth"}, {{"units", "meters"}, {"positive", "down"}});
    file.variable("lat", netcdf::Type::kFloat, {"lat"}, {{"units", "degrees_north"}});
    file.variable("lon", netcdf::Type::kFloat, {"lon"}, {{"units", "degrees_east"}});
    std::vector<std::string> shape = {"depth", "lat", "lon"};
    if (with_time) shape.insert(shape.begin(), "time");
    file.variable("t_an", netcdf::Type::kFloat, shape, {{"units", temperature_units}});
    file.variable("s_an", netcdf::Type::kFloat, shape, {{"units", "1"}});
    file.attribute("t_an", "_FillValue", kFill);
    file.attribute("s_an", "_FillValue", kFill);
    file.write("depth", depth_m);
    file.write("lat", latitude_deg);
    file.write("lon", longitude_deg);
    file.write("t_an", on_grid(temperature_c));
    file.write("s_an", on_grid(salinity_psu));
    file.commit();
  }

 private:
  [[nodiscard]] std::vector<double> on_grid(const std::function<double(double, double, double)>& f) const {
    std::vector<double> values;
    for (const double z : depth_m) {
      for (const double lat : latitude_deg) {
        for (const double lon : longitude_deg) values.push_back(f(z, lat, lon));
      }
    }
    const std::vector<double> once = values;
    for (std::size_t time = 1; time < times; ++time) values.insert(values.end(), once.begin(), once.end());
    return values;
  }
};

/// first, first + step, ... (n of them)
inline std::vector<double> axis(double first, double step, int n) {
  std::vector<double> values;
  for (int i = 0; i < n; ++i) values.push_back(first + i * step);
  return values;
}

/// What `action` says is wrong, or "no error".
template <class Action>
std::string complaint_of(const Action& action) {
  try {
    action();
  } catch (const host::BadInput& e) {
    return e.what();
  }
  return "no error";
}

}  // namespace earshot::tests
