#include "policy/python/ocean/field_module.hpp"

#include <pybind11/complex.h>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <complex>
#include <cstddef>
#include <functional>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/toml/range.hpp"
#include "policy/python/boundary/array_of.hpp"
#include "policy/python/boundary/checked.hpp"
#include "policy/python/boundary/watch.hpp"
#include "policy/python/ocean/sound_request.hpp"
#include "sim/parallel/ordered_tasks.hpp"
#include "sim/sonar/detection.hpp"
#include "sim/sonar/fan.hpp"
#include "sim/sonar/horizontal_map.hpp"
#include "sim/sonar/level_attributes.hpp"
#include "sim/sonar/sonar_field.hpp"

namespace earshot::python {
namespace {

namespace py = pybind11;
using host::Range;
using Ocean = ocean::Environment;

/// Wrong requests and what the solver cannot do become BadArgument.
template <class Work>
auto named_refusals(const Work& work) try {
  return work();
} catch (const sonar::BadRequest& bad) {
  throw bad_argument(bad);
} catch (const std::invalid_argument& bad) {  // outside of what the solver can do
  throw bad_argument(bad);
}

sonar::SonarField solved(const Ocean& ocean, const SoundRequest& asked, double bearing_deg, sonar::Pressure pressure,
                         const pe::Progress& progress) {
  const Ocean changed = ocean_of(ocean, asked);
  const Radians bearing{checked("bearing", bearing_deg, Range::between(-360.0, 360.0)) * std::numbers::pi / 180.0};
  sonar::RadialRequest request = request_of(asked, sonar::kRadialStepWavelengths);
  return named_refusals([&] {
    sonar::model_files::cover(asked.receivers, changed, bearing, request);
    const sonar::PlannedRadial radial = sonar::plan_radial(changed, bearing, request);
    return sonar::compute_sonar_field(changed, radial.section, radial.plan, progress, pressure);
  });
}

py::object tuple_of(const std::optional<pe::MarchGrid>& grid) {
  if (!grid) return py::none();
  return py::make_tuple(grid->depth_step.value, grid->range_step.value, grid->terms, grid->predicted_error_db,
                        grid->reference_wavenumber_per_m);
}

py::dict dictionary_of(sonar::SonarField&& field, bool is_snr_wanted) {
  const auto ranges = static_cast<py::ssize_t>(field.range_m.size());
  const auto depths = static_cast<py::ssize_t>(field.depth_m.size());
  py::dict result;
  result["snr"] = py::none();
  if (is_snr_wanted) result["snr"] = array_of(sonar::rounded_snr_db(field), {ranges, depths});
  result["transmission_loss"] = array_of(sonar::rounded_loss_db(std::move(field.transmission_loss_db)), {ranges, depths});
  result["pressure"] = py::none();
  if (!field.pressure.empty()) result["pressure"] = array_of(std::move(field.pressure), {ranges, depths});
  result["sea_floor_depth"] = array_of(std::move(field.sea_floor_depth_m), {ranges});
  result["range"] = array_of(std::move(field.range_m), {ranges});
  result["depth"] = array_of(std::move(field.depth_m), {depths});
  result["unmeasured_water"] = py::none();
  if (field.unmeasured) result["unmeasured_water"] = to_string(*field.unmeasured);
  result["grid"] = tuple_of(field.grid);
  return result;
}

py::dict radial(const Ocean& ocean, const SoundRequest& asked, double bearing, bool pressure, bool snr, py::object progress) {
  Watch watch(std::move(progress));
  sonar::SonarField field = [&] {
    const py::gil_scoped_release without_python;
    return solved(ocean, asked, bearing, pressure && !asked.band_hz ? sonar::Pressure::kKept : sonar::Pressure::kLeftOut, std::ref(watch));
  }();
  const std::optional<std::string> doubt = doubt_of(field, Decibels{asked.accuracy_db});
  py::dict result = dictionary_of(std::move(field), snr);
  result["doubt"] = doubt;
  return result;
}

/// What is asked all around a source, as Python gives it.
struct FanQuestion {
  std::size_t radials;
  std::size_t threads;  ///< 0: all processors
  double detection_threshold_db;
  double fluctuation_db;
  bool is_detection_wanted;
  bool is_map_wanted;
  std::optional<double> map_side_m;  ///< empty: the largest within the fan
  std::size_t map_intervals;
};

void require_allowed(const FanQuestion& question) {
  checked("radials", static_cast<double>(question.radials), Range::between(1.0, 100'000.0));
  checked("threads", static_cast<double>(question.threads), Range::between(0.0, 4096.0));
  checked("detection_threshold_db", question.detection_threshold_db, Range::between(-200.0, 200.0));
  checked("fluctuation_db", question.fluctuation_db, Range::between(0.0, 100.0));
  if (question.map_side_m) checked("side", *question.map_side_m, Range::between(1.0, 4e6));
  checked("intervals", static_cast<double>(question.map_intervals), Range::between(1.0, 10'000.0));
}

/// A fan, and what is heard of it.
struct HeardFan {
  sonar::Fan fan;
  std::vector<float> probability;  ///< [n_bearing x n_range x n_depth], of the loss before it is rounded, as files hold it
  std::vector<float> assured_m;    ///< [n_depth x n_bearing]
  std::vector<float> furthest_m;
  std::vector<sonar::HorizontalMap> maps;  ///< of each depth
  std::optional<std::string> land;
  std::optional<ocean::UnmeasuredWater> unmeasured;
};

void add_detection(HeardFan& heard, const sonar::Detector& detector) {
  heard.probability = sonar::detection_probabilities(heard.fan, detector);
  for (std::size_t depth = 0; depth < heard.fan.depth_m.size(); ++depth) {
    for (const sonar::DetectionRange& range : sonar::detection_ranges(heard.fan, depth, detector)) {
      heard.assured_m.push_back(static_cast<float>(range.assured_m));
      heard.furthest_m.push_back(static_cast<float>(range.furthest_m));
    }
  }
}

HeardFan heard_around(const Ocean& ocean, const SoundRequest& asked, const FanQuestion& question, const pe::Progress& progress) {
  const Ocean changed = ocean_of(ocean, asked);
  require_allowed(question);
  const sonar::RadialRequest request = request_of(asked, sonar::kFanStepWavelengths);
  return named_refusals([&] {
    const sonar::PlannedFan planned = sonar::plan_fan(changed, question.radials, request);
    const std::size_t threads = question.threads > 0 ? question.threads : parallel::available_processors();
    HeardFan heard{.fan = sonar::compute_fan(changed, changed.source.position, planned.plan, threads, progress),
                   .probability = {},
                   .assured_m = {},
                   .furthest_m = {},
                   .maps = {},
                   .land = planned.land,
                   .unmeasured = {}};
    heard.unmeasured = sonar::unmeasured_water(changed, heard.fan.centre, heard.fan.bearings, heard.fan.max_range());
    const sonar::Detector detector{.source_level = changed.source.level,
                                   .noise_level = changed.noise_level,
                                   .detection_threshold = Decibels{question.detection_threshold_db},
                                   .fluctuation = Decibels{question.fluctuation_db}};
    if (question.is_detection_wanted) add_detection(heard, detector);
    const Meters side = question.map_side_m ? Meters{*question.map_side_m} : sonar::largest_side(heard.fan);
    for (std::size_t depth = 0; question.is_map_wanted && depth < heard.fan.depth_m.size(); ++depth)
      heard.maps.push_back(sonar::make_map(heard.fan, depth, {.side = side, .intervals = question.map_intervals}, detector,
                                           [&](double) { progress(1.0); }));  // which asks whether to end
    return heard;
  });
}

/// The maps as they are stacked: [n_depth x n_north x n_east].
void add_maps(py::dict& result, std::vector<sonar::HorizontalMap>&& maps) {
  std::vector<float> snr_db;
  std::vector<float> probability;
  for (const sonar::HorizontalMap& map : maps) {
    snr_db.insert(snr_db.end(), map.snr_db.begin(), map.snr_db.end());
    probability.insert(probability.end(), map.detection_probability.begin(), map.detection_probability.end());
  }
  const auto side = static_cast<py::ssize_t>(maps.front().north_m.size());
  const auto depths = static_cast<py::ssize_t>(maps.size());
  result["map_snr"] = array_of(std::move(snr_db), {depths, side, side});
  result["map_detection_probability"] = array_of(std::move(probability), {depths, side, side});
  result["north"] = array_of(std::move(maps.front().north_m), {side});
  result["east"] = array_of(std::move(maps.front().east_m), {side});
}

py::dict dictionary_of(HeardFan&& heard, Decibels accuracy) {
  sonar::Fan& fan = heard.fan;
  const auto bearings = static_cast<py::ssize_t>(fan.bearings);
  const auto ranges = static_cast<py::ssize_t>(fan.ranges);
  const auto depths = static_cast<py::ssize_t>(fan.depth_m.size());
  const std::vector<py::ssize_t> shape{bearings, ranges, depths};
  py::dict result;
  result["grid"] = tuple_of(sonar::grid_of(fan));
  result["doubt"] = sonar::doubt_of(fan, accuracy);
  result["bearing"] = array_of(sonar::bearings_deg(fan), {bearings});
  result["range"] = array_of(sonar::ranges_m(fan), {ranges});
  result["transmission_loss"] = array_of(sonar::rounded_loss_db(std::move(fan.transmission_loss_db)), shape);
  result["sea_floor_depth"] = array_of(std::move(fan.sea_floor_depth_m), {bearings, ranges});
  result["depth"] = array_of(std::move(fan.depth_m), {depths});
  if (!heard.probability.empty()) {
    result["detection_probability"] = array_of(std::move(heard.probability), shape);
    result["assured_detection_range"] = array_of(std::move(heard.assured_m), {depths, bearings});
    result["furthest_detection_range"] = array_of(std::move(heard.furthest_m), {depths, bearings});
  }
  if (!heard.maps.empty()) add_maps(result, std::move(heard.maps));
  result["land"] = heard.land;
  result["unmeasured_water"] = py::none();
  if (heard.unmeasured) result["unmeasured_water"] = to_string(*heard.unmeasured);
  return result;
}

py::dict fan(const Ocean& ocean, const SoundRequest& asked, std::size_t radials, std::size_t threads, double detection_threshold_db,
             double fluctuation_db, bool detection, bool map, std::optional<double> side, std::size_t intervals, py::object progress) {
  const FanQuestion question{.radials = radials,
                             .threads = threads,
                             .detection_threshold_db = detection_threshold_db,
                             .fluctuation_db = fluctuation_db,
                             .is_detection_wanted = detection,
                             .is_map_wanted = map,
                             .map_side_m = side,
                             .map_intervals = intervals};
  Watch watch(std::move(progress));
  HeardFan heard = [&] {
    const py::gil_scoped_release without_python;
    return beside(watch, [&](const pe::Progress& report) { return heard_around(ocean, asked, question, report); });
  }();
  return dictionary_of(std::move(heard), Decibels{asked.accuracy_db});
}

/// A dictionary of the attributes that files have.
py::dict dictionary_of(const netcdf::Attributes& attributes) {
  py::dict result;
  for (const auto& [name, value] : attributes) result[py::str(name)] = value;
  return result;
}

}  // namespace

void add_fields(py::module_& module) {
  py::class_<SoundRequest>(module, "SoundRequest")
      .def(py::init([](double frequency, double source_depth, double max_range, std::vector<double> receiver_depth,
                       std::optional<double> depth_spacing, std::optional<double> output_step, double accuracy_db,
                       std::optional<std::pair<double, double>> band, std::size_t band_parts, std::string starter,
                       std::optional<double> range_step, std::optional<double> depth_step, std::size_t terms,
                       std::optional<double> absorber_wavelengths, std::vector<double> file_depth, std::vector<double> file_range) {
             return SoundRequest{.frequency_hz = frequency,
                                 .source_depth_m = source_depth,
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
                                 .receivers = {.depth_m = std::move(file_depth), .range_m = std::move(file_range)}};
           }),
           py::kw_only(), py::arg("frequency"), py::arg("source_depth"), py::arg("max_range"), py::arg("receiver_depth"),
           py::arg("depth_spacing"), py::arg("output_step"), py::arg("accuracy_db"), py::arg("band"), py::arg("band_parts"),
           py::arg("starter"), py::arg("range_step"), py::arg("depth_step"), py::arg("terms"), py::arg("absorber_wavelengths"),
           py::arg("file_depth"), py::arg("file_range"));
  module.def("radial", &radial, py::arg("ocean"), py::arg("asked"), py::kw_only(), py::arg("bearing"), py::arg("pressure"), py::arg("snr"),
             py::arg("progress"));
  module.def("fan", &fan, py::arg("ocean"), py::arg("asked"), py::kw_only(), py::arg("radials"), py::arg("threads"),
             py::arg("detection_threshold_db"), py::arg("fluctuation_db"), py::arg("detection"), py::arg("map"), py::arg("side"),
             py::arg("intervals"), py::arg("progress"));
  py::dict levels;
  levels["transmission_loss"] = dictionary_of(sonar::transmission_loss_attributes());
  levels["snr"] = dictionary_of(sonar::snr_attributes());
  levels["source_level"] = dictionary_of(sonar::source_level_attributes());
  levels["noise_level"] = dictionary_of(sonar::noise_level_attributes());
  module.attr("LEVEL_ATTRIBUTES") = levels;
}

}  // namespace earshot::python
