#include "policy/python/ocean/library_module.hpp"

#include <pybind11/numpy.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "policy/python/boundary/array_of.hpp"
#include "policy/python/boundary/checked.hpp"
#include "policy/python/boundary/watch.hpp"
#include "sim/field_library/library_file.hpp"

namespace earshot::python {
namespace {

namespace py = pybind11;
using field_library::LibraryFile;

/// A library, or some positions of it, in memory.
struct Contents {
  std::vector<std::int64_t> position;
  std::vector<double> north_m;
  std::vector<double> east_m;
  std::vector<std::uint8_t> has_field;
  std::vector<float> transmission_loss_db;  ///< [n_position x n_bearing x n_range x n_depth]; NaN where there is no field
};

std::vector<std::int64_t> chosen(const LibraryFile& file, std::optional<std::vector<std::int64_t>> positions) {
  if (!positions) {
    positions.emplace(file.positions());
    std::iota(positions->begin(), positions->end(), std::int64_t{0});
  }
  for (const std::int64_t position : *positions) {
    if (position >= 0 && static_cast<std::size_t>(position) < file.positions()) continue;
    const auto value = static_cast<double>(position);
    throw BadArgument("positions", value, named("positions", value) + "must be 0 to " + std::to_string(file.positions() - 1));
  }
  return *std::move(positions);
}

Contents contents_of(const LibraryFile& file, std::optional<std::vector<std::int64_t>> positions, Watch& watch) {
  Contents contents;
  contents.position = chosen(file, std::move(positions));
  file.require_room(contents.position.size());
  const std::size_t fan_size = file.bearings() * file.range_m().size() * file.depth_m().size();
  contents.transmission_loss_db.assign(contents.position.size() * fan_size, std::numeric_limits<float>::quiet_NaN());
  for (std::size_t i = 0; i < contents.position.size(); ++i) {
    const auto position = static_cast<std::size_t>(contents.position[i]);
    contents.north_m.push_back(file.north_m()[position]);
    contents.east_m.push_back(file.east_m()[position]);
    contents.has_field.push_back(file.has_water(position) ? 1 : 0);
    if (file.has_water(position))
      std::ranges::copy(file.fan(position).transmission_loss_db,
                        contents.transmission_loss_db.begin() + static_cast<std::ptrdiff_t>(i * fan_size));
    watch(static_cast<double>(i + 1) / static_cast<double>(contents.position.size()));
  }
  return contents;
}

template <class Number>
py::array_t<Number> axis_of(std::vector<Number> values) {
  const auto size = static_cast<py::ssize_t>(values.size());
  return array_of(std::move(values), {size});
}

py::dict read_library(const std::filesystem::path& path, std::optional<std::vector<std::int64_t>> positions, py::object progress) {
  Watch watch(std::move(progress));
  std::optional<LibraryFile> file;
  Contents contents;
  py::dict result;
  result["attributes"] = py::dict();
  std::vector<double> frequency_hz;
  {
    const py::gil_scoped_release without_python;
    file.emplace(path);
    contents = contents_of(*file, std::move(positions), watch);
    frequency_hz = file->frequency_hz();
  }
  const auto size = [](const auto& values) { return static_cast<py::ssize_t>(values.size()); };
  const std::vector<py::ssize_t> shape{size(contents.position), static_cast<py::ssize_t>(file->bearings()), size(file->range_m()),
                                       size(file->depth_m())};
  std::vector<double> bearing_deg;
  for (std::size_t j = 0; j < file->bearings(); ++j)
    bearing_deg.push_back(360.0 * static_cast<double>(j) / static_cast<double>(file->bearings()));
  result["transmission_loss"] = array_of(std::move(contents.transmission_loss_db), shape);
  result["position"] = axis_of(std::move(contents.position));
  result["position_north"] = axis_of(std::move(contents.north_m));
  result["position_east"] = axis_of(std::move(contents.east_m));
  result["has_field"] = axis_of(std::move(contents.has_field));
  result["bearing"] = axis_of(std::move(bearing_deg));
  result["range"] = axis_of(file->range_m());
  result["depth"] = axis_of(file->depth_m());
  result["frequency"] = axis_of(std::move(frequency_hz));
  result["position_depth"] = file->centre_depth().value;
  result["source_level"] = file->source_level().value;
  result["noise_level"] = file->noise_level().value;
  for (const char* const name : {"title", "environment", "environment_crc32", "library_crc32", "unmeasured_water"}) {
    if (const std::optional<std::string> text = file->text(name)) result["attributes"][name] = *text;
  }
  result["is_around_hydrophone"] = file->centre() == field_library::Centre::kHydrophone;
  return result;
}

}  // namespace

void add_libraries(py::module_& module) {
  module.def("read_library", &read_library, py::arg("path"), py::kw_only(), py::arg("positions"), py::arg("progress"));
}

}  // namespace earshot::python
