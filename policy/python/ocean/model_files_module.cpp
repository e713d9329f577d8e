#include "policy/python/ocean/model_files_module.hpp"

#include <pybind11/complex.h>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "firmware/host/file/output_file.hpp"
#include "policy/python/boundary/given_array.hpp"
#include "sim/sonar/model_files/receiver_grid.hpp"
#include "sim/sonar/model_files/shade_file.hpp"
#include "sim/sonar/model_files/tl_grid.hpp"
#include "sim/sonar/sonar_field.hpp"

namespace earshot::python {
namespace {

namespace py = pybind11;
using sonar::model_files::ReceiverGrid;
using Floats = GivenArray<float>;
using Doubles = std::vector<double>;
using Pressure = GivenArray<std::complex<double>>;

template <class Array>
auto values_of(const Array& array) {
  return std::vector<typename Array::value_type>(array.data(), array.data() + array.size());
}

/// The loss of the pressure where there is one, for a Dataset has it rounded.
void sharpen(sonar::SonarField& field) {
  for (std::size_t i = 0; i < field.pressure.size(); ++i) {
    const double intensity = std::norm(field.pressure[i]);
    if (!std::isnan(intensity)) field.transmission_loss_db[i] = static_cast<float>(sonar::transmission_loss(intensity).value);
  }
}

sonar::SonarField field_of(const Doubles& range, const Doubles& depth, const Floats& sea_floor_depth, const Floats& transmission_loss,
                           const std::optional<Pressure>& pressure) {
  const auto values = static_cast<py::ssize_t>(range.size() * depth.size());
  if (transmission_loss.size() != values || sea_floor_depth.size() != static_cast<py::ssize_t>(range.size()) ||
      (pressure && pressure->size() != values))
    throw py::value_error("all arrays must have the sizes of range and depth");
  sonar::SonarField field{.range_m = range,
                          .depth_m = depth,
                          .source_level = {},
                          .noise_level = {},
                          .transmission_loss_db = values_of(transmission_loss),
                          .sea_floor_depth_m = values_of(sea_floor_depth)};
  if (pressure) field.pressure = values_of(*pressure);
  sharpen(field);
  return field;
}

void write_shade(const std::filesystem::path& path, const Doubles& range, const Doubles& depth, const Floats& sea_floor_depth,
                 const Floats& transmission_loss, const Pressure& pressure, double reference_wavenumber, std::string title,
                 double frequency, double source_depth, bool single_precision, Doubles receiver_depth, Doubles receiver_range, bool force) {
  sonar::SonarField field = field_of(range, depth, sea_floor_depth, transmission_loss, pressure);
  if (!std::isnan(reference_wavenumber))  // of the grid, no more is needed
    field.grid = pe::MarchGrid{
        .depth_step = {}, .range_step = {}, .terms = 0, .predicted_error_db = 0.0, .reference_wavenumber_per_m = reference_wavenumber};
  const ReceiverGrid grid{.depth_m = std::move(receiver_depth), .range_m = std::move(receiver_range)};
  const sonar::model_files::ShadeSource source{.title = std::move(title), .frequency = Hertz{frequency}, .depth = Meters{source_depth}};
  const py::gil_scoped_release without_python;
  host::require_writable(path, sonar::model_files::kShadeOutput, host::replaced_by(force), "force=True replaces it");
  sonar::model_files::write_shade(path, at_receivers(field, grid), source,
                                  single_precision ? sonar::model_files::ShadeLayout::kSingle : sonar::model_files::ShadeLayout::kDouble);
}

void write_tl_grid(const std::filesystem::path& path, const Doubles& range, const Doubles& depth, const Floats& sea_floor_depth,
                   const Floats& transmission_loss, const std::optional<Pressure>& pressure, Doubles receiver_depth, Doubles receiver_range,
                   bool force) {
  const sonar::SonarField field = field_of(range, depth, sea_floor_depth, transmission_loss, pressure);
  const ReceiverGrid grid{.depth_m = std::move(receiver_depth), .range_m = std::move(receiver_range)};
  const py::gil_scoped_release without_python;
  host::require_writable(path, sonar::model_files::kGridOutput, host::replaced_by(force), "force=True replaces it");
  sonar::model_files::write_tl_grid(path, at_receivers(field, grid));
}

}  // namespace

void add_model_files(py::module_& module) {
  module.def("write_shade", &write_shade, py::arg("path"), py::kw_only(), py::arg("range"), py::arg("depth"), py::arg("sea_floor_depth"),
             py::arg("transmission_loss"), py::arg("pressure"), py::arg("reference_wavenumber"), py::arg("title"), py::arg("frequency"),
             py::arg("source_depth"), py::arg("single_precision"), py::arg("receiver_depth"), py::arg("receiver_range"), py::arg("force"));
  module.def("write_tl_grid", &write_tl_grid, py::arg("path"), py::kw_only(), py::arg("range"), py::arg("depth"),
             py::arg("sea_floor_depth"), py::arg("transmission_loss"), py::arg("pressure"), py::arg("receiver_depth"),
             py::arg("receiver_range"), py::arg("force"));
}

}  // namespace earshot::python
