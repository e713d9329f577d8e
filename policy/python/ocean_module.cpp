#include "policy/python/ocean_module.hpp"

#include <pybind11/complex.h>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <complex>
#include <cstddef>
#include <functional>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/toml/range.hpp"
#include "policy/python/array_of.hpp"
#include "policy/python/checked.hpp"
#include "policy/python/watch.hpp"
#include "sim/ocean/file/environment_file.hpp"
#include "sim/ocean/with_source.hpp"
#include "sim/search/scenario/scenario_file.hpp"
#include "sim/sonar/radial_request.hpp"
#include "sim/sonar/sonar_field.hpp"

namespace earshot::python {
namespace {

namespace py = pybind11;
using host::BadInput;
using host::Range;

using Ocean = ocean::Environment;

std::optional<Meters> checked_metres(const char* name, std::optional<double> value, const Range& allowed) {
  return value ? std::optional(Meters{checked(name, *value, allowed)}) : std::nullopt;
}

/// What `radial` is asked, as Python gives it.
struct Asked {
  double frequency_hz;
  double source_depth_m;
  double bearing_deg;
  double max_range_m;
  std::vector<double> receiver_depth_m;
  std::optional<double> depth_spacing_m;
  std::optional<double> output_step_m;
  double accuracy_db;
  std::optional<std::pair<double, double>> band_hz;
  std::size_t band_parts;
  std::string starter;
  std::optional<double> range_step_m;
  std::optional<double> depth_step_m;
  std::size_t terms;
  std::optional<double> absorber_wavelengths;
  bool pressure;
};

ocean::Band band_of(const Asked& asked) {
  if (!asked.band_hz) return {Hertz{asked.frequency_hz}, Hertz{asked.frequency_hz}};
  const Range allowed = Range::between(1.0, 10'000.0);
  const ocean::Band band{
      Hertz{checked("band", asked.band_hz->first, allowed)}, Hertz{checked("band", asked.band_hz->second, allowed)},
      static_cast<std::size_t>(checked("band_parts", static_cast<double>(asked.band_parts), Range::between(1.0, 10'000.0)))};
  if (!(band.low < band.high)) throw BadInput("band: the low frequency comes first, and must be less than the high one");
  return band;
}

std::vector<double> checked_depths(const std::vector<double>& depth_m) {
  for (std::size_t i = 0; i < depth_m.size(); ++i) {
    checked("receiver_depth", depth_m[i], Range::between(0.0, 12'000.0));
    if (i > 0 && !(depth_m[i] > depth_m[i - 1])) throw BadInput(named("receiver_depth", depth_m[i]) + "must increase");
  }
  return depth_m;
}

/// The bounds are those of the options of `earshot field`.
sonar::RadialRequest request_of(const Asked& asked) {
  if (asked.starter != "self" && asked.starter != "gaussian")
    throw BadInput("starter = \"" + asked.starter + "\": must be \"self\" or \"gaussian\"");
  sonar::RadialRequest request{.max_range = Meters{checked("max_range", asked.max_range_m, Range::between(1.0, 2e6))},
                               .depth_m = checked_depths(asked.receiver_depth_m),
                               .depth_spacing = checked_metres("depth_spacing", asked.depth_spacing_m, Range::between(0.1, 10'000.0)),
                               .output_step = checked_metres("output_step", asked.output_step_m, Range::between(0.01, 100'000.0)),
                               .band = band_of(asked)};
  request.options.accuracy = Decibels{checked("accuracy_db", asked.accuracy_db, Range::between(0.0001, 10.0))};
  request.options.starter = asked.starter == "gaussian" ? pe::Starter::kGaussian : pe::Starter::kSelf;
  request.options.range_step = checked_metres("range_step", asked.range_step_m, Range::between(0.01, 10'000.0));
  request.options.depth_step = checked_metres("depth_step", asked.depth_step_m, Range::between(0.001, 1'000.0));
  request.options.terms = static_cast<std::size_t>(checked("terms", static_cast<double>(asked.terms), Range::between(0.0, 16.0)));
  if (asked.absorber_wavelengths)
    request.options.absorber_wavelengths = checked("absorber_wavelengths", *asked.absorber_wavelengths, Range::between(0.5, 10'000.0));
  return request;
}

/// The ocean with the source that is asked for.
Ocean ocean_of(const Ocean& ocean, const Asked& asked) {
  checked("frequency", asked.frequency_hz, Range::between(1.0, 10'000.0));
  checked("source_depth", asked.source_depth_m, Range::above_up_to(0.0, 12'000.0));
  return ocean::with_source(ocean, Hertz{asked.frequency_hz}, Meters{asked.source_depth_m}, "source_depth");
}

const char* argument_of(sonar::BadRequest::What what) {
  switch (what) {
    case sonar::BadRequest::What::kDepth:
      return "receiver_depth";
    case sonar::BadRequest::What::kOutputStep:
      return "output_step";
    case sonar::BadRequest::What::kBearing:
      return "bearing";
    case sonar::BadRequest::What::kRadials:
      return "radials";
  }
  return "";
}

sonar::SonarField solved(const Ocean& ocean, const Asked& asked, const pe::Progress& progress) {
  const Ocean changed = ocean_of(ocean, asked);
  const Radians bearing{checked("bearing", asked.bearing_deg, Range::between(-360.0, 360.0)) * std::numbers::pi / 180.0};
  const sonar::RadialRequest request = request_of(asked);
  const auto pressure = asked.pressure && !asked.band_hz ? sonar::Pressure::kKept : sonar::Pressure::kLeftOut;
  try {
    const sonar::PlannedRadial radial = sonar::plan_radial(changed, bearing, request);
    return sonar::compute_sonar_field(changed, radial.section, radial.plan, progress, pressure);
  } catch (const sonar::BadRequest& bad) {
    throw BadInput(bad.called(argument_of(bad.what_is_wrong())));
  } catch (const std::invalid_argument& bad) {  // outside of what the solver can do
    throw BadInput(bad.what());
  }
}

py::dict dictionary_of(sonar::SonarField&& field) {
  const auto ranges = static_cast<py::ssize_t>(field.range_m.size());
  const auto depths = static_cast<py::ssize_t>(field.depth_m.size());
  py::dict result;
  result["transmission_loss"] = array_of(sonar::rounded_loss_db(field.transmission_loss_db), {ranges, depths});
  result["snr"] = array_of(sonar::rounded_snr_db(field), {ranges, depths});
  result["pressure"] = py::none();
  if (!field.pressure.empty()) result["pressure"] = array_of(std::move(field.pressure), {ranges, depths});
  result["sea_floor_depth"] = array_of(std::move(field.sea_floor_depth_m), {ranges});
  result["range"] = array_of(std::move(field.range_m), {ranges});
  result["depth"] = array_of(std::move(field.depth_m), {depths});
  result["unmeasured_water"] = py::none();
  if (field.unmeasured) result["unmeasured_water"] = to_string(*field.unmeasured);
  result["grid"] = py::none();
  if (field.grid)
    result["grid"] = py::make_tuple(field.grid->depth_step.value, field.grid->range_step.value, field.grid->terms,
                                    field.grid->predicted_error_db, field.grid->reference_wavenumber_per_m);
  return result;
}

py::dict radial(const Ocean& ocean, double frequency, double source_depth, double bearing, double max_range,
                std::vector<double> receiver_depth, std::optional<double> depth_spacing, std::optional<double> output_step,
                double accuracy_db, std::optional<std::pair<double, double>> band, std::size_t band_parts, std::string starter,
                std::optional<double> range_step, std::optional<double> depth_step, std::size_t terms,
                std::optional<double> absorber_wavelengths, bool pressure, py::object progress) {
  const Asked asked{.frequency_hz = frequency,
                    .source_depth_m = source_depth,
                    .bearing_deg = bearing,
                    .max_range_m = max_range,
                    .receiver_depth_m = std::move(receiver_depth),
                    .depth_spacing_m = depth_spacing,
                    .output_step_m = output_step,
                    .accuracy_db = accuracy_db,
                    .band_hz = band,
                    .band_parts = band_parts,
                    .starter = std::move(starter),
                    .range_step_m = range_step,
                    .depth_step_m = depth_step,
                    .terms = terms,
                    .absorber_wavelengths = absorber_wavelengths,
                    .pressure = pressure};
  Watch watch(std::move(progress));
  sonar::SonarField field = [&] {
    const py::gil_scoped_release without_python;
    return solved(ocean, asked, std::ref(watch));
  }();
  return dictionary_of(std::move(field));
}

}  // namespace

void add_ocean(py::module_& module) {
  py::class_<Ocean, std::shared_ptr<Ocean>>(module, "Ocean")
      .def_static(
          "from_file", [](const std::filesystem::path& path) { return search::load_scenario(path).environment; }, py::arg("path"),
          py::call_guard<py::gil_scoped_release>())
      .def_static("from_text", &ocean::environment_of_text, py::arg("name"), py::arg("text"), py::call_guard<py::gil_scoped_release>())
      .def_property_readonly("name", [](const Ocean& ocean) { return ocean.name; })
      .def_property_readonly("frequency", [](const Ocean& ocean) { return ocean.source.frequency.value; })
      .def_property_readonly("source_depth", [](const Ocean& ocean) { return ocean.source.depth.value; })
      .def_property_readonly("source_level", [](const Ocean& ocean) { return ocean.source.level.value; })
      .def_property_readonly("noise_level", [](const Ocean& ocean) { return ocean.noise_level.value; })
      .def_property_readonly("sea_floor_depth", [](const Ocean& ocean) { return ocean.seabed.depth.value; })
      .def_property_readonly("crc32", [](const Ocean& ocean) { return ocean.file_crc32; });
  module.def("radial", &radial, py::arg("ocean"), py::kw_only(), py::arg("frequency"), py::arg("source_depth"), py::arg("bearing"),
             py::arg("max_range"), py::arg("receiver_depth"), py::arg("depth_spacing"), py::arg("output_step"), py::arg("accuracy_db"),
             py::arg("band"), py::arg("band_parts"), py::arg("starter"), py::arg("range_step"), py::arg("depth_step"), py::arg("terms"),
             py::arg("absorber_wavelengths"), py::arg("pressure"), py::arg("progress"));
}

}  // namespace earshot::python
