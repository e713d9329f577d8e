#include "policy/python/ocean/ocean_module.hpp"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "firmware/host/file/input_file.hpp"
#include "firmware/host/toml/range.hpp"
#include "policy/python/boundary/checked.hpp"
#include "sim/ocean/file/acoustics_toolbox/env_file.hpp"
#include "sim/ocean/file/environment_file.hpp"
#include "sim/ocean/file/ram/ram_file.hpp"
#include "sim/ocean/radial_case.hpp"
#include "sim/search/scenario/scenario_file.hpp"

namespace earshot::python {
namespace {

namespace py = pybind11;
using host::Range;

using Ocean = ocean::Environment;

/// An ocean of a file that names no levels, with those that somebody knows.
Ocean with_levels(const Ocean& ocean, double source_level, double noise_level) {
  Ocean changed = ocean;
  changed.source.level = Decibels{checked("source_level", source_level, Range::between(0.0, 300.0))};
  changed.noise_level = Decibels{checked("noise_level", noise_level, Range::between(-100.0, 300.0))};
  return changed;
}

void add_radial_case(py::module_& module) {
  using Case = ocean::RadialCase;
  py::class_<Case>(module, "RadialCase")
      .def_static("from_acoustics_toolbox", &ocean::acoustics_toolbox::load_env, py::arg("path"), py::call_guard<py::gil_scoped_release>())
      .def_static("from_ram", &ocean::ram::load_ram, py::arg("path"), py::call_guard<py::gil_scoped_release>())
      .def_property_readonly("ocean", [](const Case& of_file) { return of_file.environment; })
      .def_property_readonly("source_depth",
                             [](const Case& of_file) {
                               return of_file.source_depth_m.empty() ? std::vector<double>{of_file.environment.source.depth.value}
                                                                     : of_file.source_depth_m;
                             })
      .def_property_readonly("receiver_depth", [](const Case& of_file) { return of_file.receiver_depth_m; })
      .def_property_readonly("receiver_range", [](const Case& of_file) { return of_file.receiver_range_m; })
      .def_property_readonly("max_range", [](const Case& of_file) {
        const std::optional<Meters> furthest = of_file.furthest();
        return furthest ? std::optional(furthest->value) : std::nullopt;
      });
}

}  // namespace

void add_ocean(py::module_& module) {
  py::class_<Ocean, std::shared_ptr<Ocean>>(module, "Ocean")
      .def_static(
          "from_file", [](const std::filesystem::path& path) { return search::load_scenario(path).environment; }, py::arg("path"),
          py::call_guard<py::gil_scoped_release>())
      .def_static("from_text", &ocean::environment_of_text, py::arg("name"), py::arg("text"), py::call_guard<py::gil_scoped_release>())
      .def("with_levels", &with_levels, py::kw_only(), py::arg("source_level"), py::arg("noise_level"))
      .def_property_readonly("name", [](const Ocean& ocean) { return ocean.name; })
      .def_property_readonly("frequency", [](const Ocean& ocean) { return ocean.source.frequency.value; })
      .def_property_readonly("source_depth", [](const Ocean& ocean) { return ocean.source.depth.value; })
      .def_property_readonly("source_level", [](const Ocean& ocean) { return ocean.source.level.value; })
      .def_property_readonly("noise_level", [](const Ocean& ocean) { return ocean.noise_level.value; })
      .def_property_readonly("sea_floor_depth", [](const Ocean& ocean) { return ocean.seabed.depth.value; })
      .def_property_readonly("crc32", [](const Ocean& ocean) { return ocean.file_crc32; });
  add_radial_case(module);
  module.attr("MOST_TOML_BYTES") = host::kTomlFile.most_bytes;
}

}  // namespace earshot::python
