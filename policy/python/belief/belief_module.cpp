#include "policy/python/belief/belief_module.hpp"

#include <pybind11/numpy.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <variant>
#include <vector>

#include "firmware/config/capacities.hpp"
#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/policy/tables_bytes.hpp"
#include "firmware/host/toml/range.hpp"
#include "firmware/messages/snr_measurement.hpp"
#include "firmware/policy/ocean_belief/ocean_belief.hpp"
#include "policy/python/belief/ocean_tables.hpp"
#include "policy/python/boundary/array_of.hpp"
#include "policy/python/boundary/checked.hpp"
#include "policy/python/boundary/watch.hpp"
#include "sim/search/belief_model.hpp"

namespace earshot::python {
namespace {

namespace py = pybind11;
using host::BadInput;
using host::Range;
using Place = std::pair<double, double>;                                        // north, east
using BearingGiven = std::tuple<double, double, std::optional<double>>;         // direction, deviation, mirror axis, degrees
using Measured = std::tuple<Place, double, bool, std::optional<BearingGiven>>;  // position, SNR, whether too faint, bearing

constexpr double kDegree = std::numbers::pi / 180.0;

std::shared_ptr<Tables> make(std::vector<std::variant<std::shared_ptr<ocean::Environment>, std::filesystem::path>> oceans,
                             double vehicle_depth, double max_range, double range_step, std::size_t bearings, std::size_t at_most,
                             py::object progress) {
  const Meters furthest{checked("max_range", max_range, Range::between(1.0, 1e7))};
  const Meters step{checked("range_step", range_step, Range::between(1.0, policy::kMostRangeStep_m))};
  const double ranges = tables::range_count(furthest, step);
  constexpr auto kMost = static_cast<double>(config::kMaxTableRanges);
  if (!(ranges <= kMost))
    throw BadInput(named("range_step", range_step) + "gives more than the " + std::to_string(config::kMaxTableRanges) +
                   " ranges that a vehicle holds, with max_range = " + std::to_string(std::lround(max_range)));
  const TablesAsked asked{
      .oceans = std::move(oceans),
      .plan = {.vehicle_depth = Meters{checked("vehicle_depth", vehicle_depth, Range::between(0.1, policy::kMostDepth_m))},
               .range_step = step,
               .range_count = static_cast<std::size_t>(ranges),
               .bearings = static_cast<std::size_t>(checked("bearings", static_cast<double>(bearings), Range::between(1.0, 360.0)))},
      .at_most = static_cast<std::size_t>(
          checked("at_most", static_cast<double>(at_most), Range::between(1.0, static_cast<double>(config::kMaxOceanTables))))};
  Watch watch(std::move(progress));
  const py::gil_scoped_release without_python;
  return std::make_shared<Tables>(make_tables(asked, std::ref(watch)));
}

std::shared_ptr<Tables> from_file(const std::filesystem::path& path) {
  const py::gil_scoped_release without_python;
  return std::make_shared<Tables>(tables_of(host::read_tables_bytes(path), path));
}

std::shared_ptr<Tables> from_bytes(const std::string& bytes) {
  return std::make_shared<Tables>(tables_of({bytes.begin(), bytes.end()}, "the pickled tables"));
}

/// [table x range]
py::array_t<float> snr_db(const Tables& tables) {
  std::vector<float> all;
  for (const policy::OceanTable& table : tables.of->tables)
    for (std::size_t i = 0; i < tables.of->range_count; ++i) all.push_back(table.snr_db(i));
  return array_of(std::move(all), {static_cast<py::ssize_t>(tables.of->tables.size()), static_cast<py::ssize_t>(tables.of->range_count)});
}

std::string name_of(const policy::OceanTable& table) {
  return {table.name.begin(), table.name.end()};
}

py::bytes bytes_of(const Tables& tables) {
  return {reinterpret_cast<const char*>(tables.bytes.data()), tables.bytes.size()};
}

py::dict described(const Tables& tables) {
  const policy::OceanTables& of = *tables.of;
  py::list names;
  py::list priors;
  py::list sea_depths;
  for (const policy::OceanTable& table : of.tables) {
    names.append(name_of(table));
    priors.append(table.prior);
    sea_depths.append(table.sea_depth_m);
  }
  const auto pair_of = [](policy::DepthRange depths) { return Place{depths.least.value, depths.most.value}; };
  py::dict dictionary;
  dictionary["frequency"] = of.frequency.value;
  dictionary["vehicle_depth"] = of.receiver_depth.value;
  dictionary["source_depth"] = pair_of(of.source_depth);
  dictionary["sea_depth"] = pair_of(of.sea_depth);
  dictionary["range_step"] = of.range_step.value;
  dictionary["provenance"] = std::string(of.provenance.begin(), of.provenance.end());
  dictionary["name"] = names;
  dictionary["prior"] = priors;
  dictionary["sea_floor_depth"] = sea_depths;
  return dictionary;
}

policy::BeliefModel model_of(Place area, double step_length, std::size_t directions, double border_width, double threshold_db) {
  const Range length = Range::between(1.0, 1e6);
  const Range side = Range::between(1.0, 1e7);
  search::SearchSettings settings;
  settings.domain = {.south_west = {},
                     .north_east = {Meters{checked("area", area.first, side)}, Meters{checked("area", area.second, side)}}};
  settings.step_length = Meters{checked("step_length", step_length, length)};
  settings.direction_count = static_cast<std::size_t>(
      checked("directions", static_cast<double>(directions), Range::between(1.0, static_cast<double>(config::kMaxActions))));
  settings.border_width = Meters{checked("border_width", border_width, length)};
  settings.detection_threshold = Decibels{checked("detection_threshold", threshold_db, Range::between(-100.0, 100.0))};
  const policy::BeliefModel model = search::belief_model(settings);
  if (!policy::has_valid_shape(model) || !policy::has_valid_numbers(model)) throw BadInput("area: no grid of cells fits it");
  return model;
}

policy::Reception reception_of(double snr, bool too_faint, const std::optional<BearingGiven>& bearing) {
  const double most = messages::kMostSnr.value;
  policy::Reception reception{.snr = Decibels{checked("snr", snr, Range::between(-most, most))}, .too_faint = too_faint};
  if (!bearing) return reception;
  const auto& [direction, deviation, axis] = *bearing;
  messages::Bearing heard{.direction = Radians{kDegree * direction}, .deviation = Radians{kDegree * deviation}};
  if (axis) heard.mirror_axis = Radians{kDegree * *axis};
  if (!messages::is_possible(heard))
    throw BadInput("bearing: direction and mirror axis must be 0 to 360 degrees, the deviation above 0 and at most 180");
  reception.bearing = heard;
  return reception;
}

/// The belief that flies, and what it was told: that is its pickle.
class BeliefState {
 public:
  BeliefState(std::shared_ptr<Tables> tables, Place area, double step_length, std::size_t directions, double border_width,
              double detection_threshold)
      : tables_(std::move(tables)),
        arguments_(area, step_length, directions, border_width, detection_threshold),
        model_(model_of(area, step_length, directions, border_width, detection_threshold)),
        belief_(std::make_unique<policy::OceanBelief>()) {
    const double furthest = std::hypot(area.first, area.second);
    if (policy::reach(*tables_->of).value < furthest)
      throw BadInput("tables: end at " + std::to_string(std::lround(policy::reach(*tables_->of).value)) +
                     " m; must extend across the area, " + std::to_string(static_cast<long>(std::ceil(furthest))) + " m");
    belief_->start(model_, *tables_->of);
  }
  BeliefState(const BeliefState& other)
      : tables_(other.tables_),
        arguments_(other.arguments_),
        model_(other.model_),
        belief_(std::make_unique<policy::OceanBelief>(*other.belief_)),
        measurements_(other.measurements_) {}
  BeliefState& operator=(const BeliefState&) = delete;

  void update(Place position, double snr, bool too_faint, std::optional<BearingGiven> bearing) {
    const Range allowed = Range::between(-1e7, 1e7);
    const NorthEast place{Meters{checked("position", position.first, allowed)}, Meters{checked("position", position.second, allowed)}};
    belief_->update(model_, *tables_->of, place, reception_of(snr, too_faint, bearing));
    measurements_.emplace_back(position, snr, too_faint, std::move(bearing));
  }

  [[nodiscard]] py::tuple state() const { return py::make_tuple(tables_, py::cast(arguments_), py::cast(measurements_)); }
  static std::unique_ptr<BeliefState> from_state(const py::tuple& state) {
    if (state.size() != 3) throw BadInput("not a belief that was pickled");
    const auto [area, step, directions, border, threshold] = state[1].cast<Arguments>();
    auto belief = std::make_unique<BeliefState>(state[0].cast<std::shared_ptr<Tables>>(), area, step, directions, border, threshold);
    for (const auto& [position, snr, too_faint, bearing] : state[2].cast<std::vector<Measured>>())
      belief->update(position, snr, too_faint, bearing);
    return belief;
  }

  /// [north x east]
  [[nodiscard]] py::array_t<float> probabilities() const {
    std::vector<float> all;
    for (std::size_t north = 0; north < model_.cells_north; ++north)
      for (std::size_t east = 0; east < model_.cells_east; ++east) all.push_back(belief_->probability(model_, north, east));
    return array_of(std::move(all), {model_.cells_north, model_.cells_east});
  }

  [[nodiscard]] py::dict summary() const {
    const messages::BeliefSummary& summary = belief_->summary();
    py::dict dictionary;
    dictionary["likeliest"] = pair_of(summary.likeliest);
    dictionary["mean"] = pair_of(summary.mean);
    dictionary["spread"] = summary.spread.value;
    dictionary["likeliest_share"] = summary.likeliest_share;
    dictionary["effective_cells"] = summary.effective_cells;
    dictionary["mismatch_bits"] = belief_->model_mismatch().bits();
    dictionary["is_mismatched"] = belief_->model_mismatch().is_mismatched();
    dictionary["calls_for_sweep"] = belief_->calls_for_sweep();
    return dictionary;
  }

  /// A dict for each that is retained.
  [[nodiscard]] py::list hypotheses() const {
    py::list all;
    for (std::size_t i = 0; i < policy::OceanBelief::kHypotheses; ++i) {
      const policy::Hypothesis& hypothesis = belief_->hypothesis(i);
      const policy::Mobility& mobility = policy::kMobilities[hypothesis.mobility];
      constexpr double kPart = 1.0 / policy::kDriftParts;
      py::dict one;
      one["probability"] = belief_->share(i);
      one["ocean"] = name_of(tables_->of->tables[hypothesis.table]);
      one["table"] = hypothesis.table;
      one["level_offset_db"] = policy::kLevelOffsets_db[hypothesis.level];
      one["spread_db"] = policy::kSpreads_db[hypothesis.spread];
      one["silence_share"] = policy::kSilenceShares[hypothesis.silence];
      one["moves_cells"] = mobility.cells;
      one["drift_north_steps"] = kPart * hypothesis.drift.north;
      one["drift_east_steps"] = kPart * hypothesis.drift.east;
      one["is_current"] = hypothesis.drift.is_current;
      all.append(one);
    }
    return all;
  }

  /// A dict for each action, in the order of the actions.
  [[nodiscard]] py::list actions() const {
    py::list all;
    for (std::size_t i = 0; i < model_.actions.size(); ++i) {
      const policy::ActionValues& values = belief_->action_values(i);
      py::dict one;
      one["direction_deg"] = 360.0 * static_cast<double>(i) / static_cast<double>(model_.actions.size());
      one["found"] = values.found;
      one["find_probability"] = values.find_probability;
      one["detected"] = values.detected;
      one["border"] = values.border;
      one["regret"] = values.regret;
      all.append(one);
    }
    return all;
  }

  [[nodiscard]] py::object declaration() const {
    const auto& declaration = belief_->declaration();
    if (!declaration) return py::none();
    py::dict dictionary;
    dictionary["probability"] = declaration->probability;
    dictionary["likeliest"] = pair_of(declaration->likeliest);
    dictionary["closest_approach"] = declaration->closest_approach.value;
    dictionary["least_snr"] = declaration->least_snr.value;
    return dictionary;
  }

  [[nodiscard]] std::shared_ptr<Tables> tables() const { return tables_; }
  [[nodiscard]] Place area() const { return pair_of(model_.area_size); }
  [[nodiscard]] std::size_t measurements() const { return measurements_.size(); }
  [[nodiscard]] std::uint32_t fingerprint() const { return belief_->fingerprint(model_); }

 private:
  using Arguments = std::tuple<Place, double, std::size_t, double, double>;

  static Place pair_of(NorthEast place) { return {place.north.value, place.east.value}; }

  std::shared_ptr<Tables> tables_;
  Arguments arguments_;
  policy::BeliefModel model_;
  std::unique_ptr<policy::OceanBelief> belief_;
  std::vector<Measured> measurements_;
};

}  // namespace

void add_belief(py::module_& module) {
  py::class_<Tables, std::shared_ptr<Tables>>(module, "Tables")
      .def_static("from_file", &from_file, py::arg("path"))
      .def_static("make", &make, py::kw_only(), py::arg("oceans"), py::arg("vehicle_depth"), py::arg("max_range"), py::arg("range_step"),
                  py::arg("bearings"), py::arg("at_most"), py::arg("progress"))
      .def(py::pickle([](const Tables& tables) { return bytes_of(tables); }, [](const py::bytes& bytes) { return from_bytes(bytes); }))
      .def_property_readonly("bytes", &bytes_of)
      .def_property_readonly("described", &described)
      .def_property_readonly("snr_db", &snr_db);
  py::class_<BeliefState>(module, "BeliefState")
      .def(py::init<std::shared_ptr<Tables>, Place, double, std::size_t, double, double>(), py::kw_only(), py::arg("tables"),
           py::arg("area"), py::arg("step_length"), py::arg("directions"), py::arg("border_width"), py::arg("detection_threshold"))
      .def(py::pickle([](const BeliefState& belief) { return belief.state(); },
                      [](const py::tuple& state) { return BeliefState::from_state(state); }))
      .def("__copy__", [](const BeliefState& belief) { return std::make_unique<BeliefState>(belief); })
      .def(
          "__deepcopy__", [](const BeliefState& belief, const py::dict&) { return std::make_unique<BeliefState>(belief); }, py::arg("memo"))
      .def("update", &BeliefState::update, py::arg("position"), py::kw_only(), py::arg("snr"), py::arg("too_faint"), py::arg("bearing"))
      .def_property_readonly("tables", &BeliefState::tables)
      .def_property_readonly("area", &BeliefState::area)
      .def_property_readonly("measurements", &BeliefState::measurements)
      .def_property_readonly("fingerprint", &BeliefState::fingerprint)
      .def("probabilities", &BeliefState::probabilities)
      .def("summary", &BeliefState::summary)
      .def("hypotheses", &BeliefState::hypotheses)
      .def("actions", &BeliefState::actions)
      .def("declaration", &BeliefState::declaration);
}

}  // namespace earshot::python
