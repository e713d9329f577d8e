#include "policy/python/listening_module.hpp"

#include <pybind11/numpy.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <iterator>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "firmware/host/file/printable.hpp"
#include "firmware/host/toml/table_reader.hpp"
#include "policy/python/boundary/array_of.hpp"
#include "policy/python/boundary/checked.hpp"
#include "policy/python/boundary/given_array.hpp"
#include "policy/python/boundary/watch.hpp"
#include "sim/annotation/score.hpp"
#include "sim/annotation/selection_table.hpp"
#include "sim/listening/levels.hpp"
#include "sim/listening/listening.hpp"
#include "sim/listening/stream.hpp"
#include "sim/listening/truth.hpp"
#include "sim/recording/clock_text.hpp"
#include "sim/recording/sound_folder.hpp"

namespace earshot::python {
namespace {

namespace py = pybind11;
using host::BadInput;
using host::Range;
using listening::Plan;

using Samples = GivenArray<float>;

/// NumPy's "not a time".
constexpr std::int64_t kNoTime = std::numeric_limits<std::int64_t>::min();

std::vector<py::ssize_t> shape_of(std::initializer_list<std::size_t> sizes) {
  return {sizes.begin(), sizes.end()};
}

/// As os.fsdecode gives it: what it is given back for is the same bytes.
py::str text_of(const std::filesystem::path& path) {
  const std::string& bytes = path.native();
  return py::reinterpret_steal<py::str>(PyUnicode_DecodeFSDefaultAndSize(bytes.data(), static_cast<py::ssize_t>(bytes.size())));
}

std::vector<std::string> printable(std::vector<std::string> sentences) {
  for (std::string& sentence : sentences) sentence = host::printable(sentence);
  return sentences;
}

/// What is asked of any sound, as Python gives it.
struct Asked {
  std::string preset;
  std::optional<std::pair<double, double>> band_hz;
  std::optional<double> threshold_db;
  std::int64_t channel;
  std::optional<std::filesystem::path> calibration;  ///< a file, or the name of calibration_text
  std::optional<std::string> calibration_text;
  std::optional<double> full_scale_db;
  std::optional<double> levels_interval_s;
};

std::optional<listening::Chain> chain_of(const Asked& asked) {
  if (asked.calibration && asked.calibration_text)
    return listening::read_calibration(host::TomlFile(*asked.calibration, *asked.calibration_text));
  if (asked.calibration) return listening::read_calibration(host::TomlFile(*asked.calibration));
  if (!asked.full_scale_db) return std::nullopt;
  return listening::Chain{.full_scale_level = Decibels{checked("full_scale_db", *asked.full_scale_db, listening::kFullScaleLevels_db)},
                          .from = "full_scale_db"};
}

listening::Request request_of(const Asked& asked) {
  const std::vector<std::string> presets = listening::preset_names();
  if (std::ranges::find(presets, asked.preset) == presets.end()) {
    std::string names;
    for (const std::string& name : presets) names += (names.empty() ? "" : ", ") + name;
    throw BadInput("preset = \"" + asked.preset + "\": must be one of " + names);
  }
  const double channel = checked("channel", static_cast<double>(asked.channel), Range::between(1.0, listening::kMostChannels));
  listening::Request request{
      .preset = asked.preset, .band = {}, .threshold = {}, .channel = static_cast<std::size_t>(channel), .chain = chain_of(asked)};
  if (asked.band_hz) {
    request.band = {.low = Hertz{checked("band", asked.band_hz->first, listening::kBandEdges_hz)},
                    .high = Hertz{checked("band", asked.band_hz->second, listening::kBandEdges_hz)}};
  }
  if (asked.threshold_db) request.threshold = Decibels{checked("threshold_db", *asked.threshold_db, listening::kThresholds_db)};
  return request;
}

listening::Wanted wanted_of(const Asked& asked) {
  listening::Wanted wanted;
  if (asked.levels_interval_s)
    wanted.levels_interval_s = checked("levels_interval", *asked.levels_interval_s, listening::kLevelsIntervals_s);
  return wanted;
}

std::optional<Time> time_of(const std::optional<std::string>& begin) {
  if (!begin) return std::nullopt;
  if (const std::string fault = recording::fault_of_iso(*begin); !fault.empty()) throw BadInput("begin = " + *begin + ": " + fault);
  return recording::read_iso(*begin)->utc;
}

template <class Number, class Value>
py::array_t<Number> column(const std::vector<listening::Row>& rows, Value value) {
  std::vector<Number> values;
  values.reserve(rows.size());
  std::ranges::transform(rows, std::back_inserter(values), value);
  return array_of(std::move(values), shape_of({rows.size()}));
}

py::dict rows_of(const std::vector<listening::Row>& rows, const Plan& plan) {
  using listening::Row;
  py::dict columns;
  columns["begin_s"] = column<double>(rows, [](const Row& row) { return row.begin_s; });
  columns["duration_s"] = column<double>(rows, [](const Row& row) { return row.duration_s; });
  columns["begin_utc_us"] = column<std::int64_t>(rows, [](const Row& row) { return row.place.utc ? row.place.utc->us : kNoTime; });
  columns["peak_s"] = column<double>(rows, [](const Row& row) { return row.peak_s; });
  columns["snr_db"] = column<double>(rows, [](const Row& row) { return row.snr_db; });
  columns["level_db"] = column<double>(rows, [](const Row& row) { return row.level_db; });
  columns["file_offset_s"] = column<double>(rows, [](const Row& row) { return row.place.offset.to_seconds(); });
  columns["is_clipped"] = column<std::uint8_t>(rows, [](const Row& row) { return static_cast<std::uint8_t>(row.is_clipped); });
  py::list files;
  for (const Row& row : rows) files.append(text_of(plan.sequence.parts()[row.place.part].path));
  columns["file"] = files;
  return columns;
}

py::object dictionary_of(const spectrum::BandLevels* all, const Plan& plan, std::size_t first) {
  if (all == nullptr) return py::none();
  listening::Levels levels = levels_of(*all, plan, first);
  const std::size_t intervals = levels.begin_s.size();
  const std::size_t bands = levels.bands.size();
  std::vector<double> centre_hz;
  for (const spectrum::ThirdOctave& band : levels.bands) centre_hz.push_back(band.centre.value);
  py::dict dictionary;
  dictionary["is_dated"] = levels.is_dated;
  dictionary["begin_s"] = array_of(std::move(levels.begin_s), shape_of({intervals}));
  dictionary["frequency_hz"] = array_of(std::move(centre_hz), shape_of({bands}));
  dictionary["percentile"] = py::cast(spectrum::kPercentiles);
  dictionary["level_db"] = array_of(std::move(levels.level_db), shape_of({intervals, bands}));
  dictionary["level_percentile_db"] =
      array_of(std::move(levels.level_percentile_db), shape_of({intervals, spectrum::kPercentiles.size(), bands}));
  return dictionary;
}

py::list files_of(const Plan& plan) {
  py::list files;
  for (const recording::Part& part : plan.sequence.parts())
    files.append(py::make_tuple(text_of(part.path), (plan.sequence.time_of(part.begin) - Time{}).to_seconds(), part.first_frame,
                                part.frames, part.notes.start ? part.notes.start->us : kNoTime, host::printable(part.notes.recorder)));
  return files;
}

/// What holds of all rows.
py::dict settings_of(const Plan& plan) {
  py::dict settings;
  settings["level_unit"] = plan.chain.unit();
  settings["is_calibrated"] = plan.chain.is_calibrated();
  settings["full_scale_level_db"] = plan.chain.full_scale_level ? py::cast(plan.chain.full_scale_level->value) : py::none();
  settings["calibration"] = host::printable(plan.chain.from);
  settings["sample_rate_hz"] = plan.sequence.sample_rate().value;
  settings["band_hz"] = py::make_tuple(plan.settings.band.low.value, plan.settings.band.high.value);
  settings["threshold_db"] = plan.settings.detection_threshold.value;
  settings["integration_time_s"] = plan.settings.integration_time.to_seconds();
  return settings;
}

/// @param given_rows, given_intervals  how many were given before
py::dict dictionary_of(const listening::Heard& heard, const Plan& plan, std::size_t given_rows, std::size_t given_intervals) {
  py::dict dictionary;
  dictionary["rows"] = rows_of({heard.rows.begin() + static_cast<std::ptrdiff_t>(given_rows), heard.rows.end()}, plan);
  dictionary["levels"] = dictionary_of(heard.levels.get(), plan, given_intervals);
  dictionary["settings"] = settings_of(plan);
  dictionary["files"] = files_of(plan);
  dictionary["listened_s"] = heard.listened_s;
  dictionary["noise_db"] = heard.noise_db;
  py::dict not_heard;
  for (const listening::Heard::Obstacle& obstacle : heard.obstacles) not_heard[py::str(obstacle.what)] = obstacle.seconds;
  dictionary["not_heard_s"] = not_heard;
  std::vector<std::string> remarks = plan.remarks;
  if (heard.missing_frames > 0) remarks.push_back(missing_to_string(heard));
  dictionary["remarks"] = printable(std::move(remarks));
  return dictionary;
}

py::dict listen_to_files(const std::vector<std::filesystem::path>& files, const std::optional<std::string>& begin,
                         const std::optional<std::string>& time_format, const Asked& asked, py::object progress) {
  Watch watch(std::move(progress));
  std::optional<Plan> plan;
  const listening::Heard heard = [&] {
    const py::gil_scoped_release without_python;
    const std::string fault = time_format ? recording::fault_of_format(*time_format) : "";
    if (!fault.empty()) throw BadInput("time_format = " + *time_format + ": " + fault);
    const listening::Wanted wanted = wanted_of(asked);
    const listening::Request request = request_of(asked);
    recording::Sequence sequence(recording::recordings_in(files), {.begin = time_of(begin), .name_format = time_format.value_or("")});
    plan.emplace(listening::plan_for(std::move(sequence), request));
    plan->chain.divisor = listening::divisor_for(listening::largest_magnitude(plan->sequence, [&watch] { watch(0.0); }));
    return listening::listen_to(*plan, wanted, std::ref(watch));
  }();
  return dictionary_of(heard, *plan, 0, 0);
}

/// Sound in memory, block by block.
class SoundStream {
 public:
  SoundStream(double rate, std::int64_t bits, double largest_magnitude, const std::optional<std::string>& begin, Asked asked) {
    checked("rate", rate, Range::above(0.0));
    const int stored = static_cast<int>(checked("bits", static_cast<double>(bits), Range::between(8.0, 32.0)));
    asked.channel = 1;  // a stream has one
    const recording::SoundFormat format{.sample_rate = Hertz{rate}, .channels = 1, .bits = stored, .stored_bits = stored};
    Plan plan = listening::plan_for(listening::sequence_of_samples(format, time_of(begin)), request_of(asked));
    plan.chain.divisor = listening::divisor_for(checked("largest_magnitude", largest_magnitude, Range::above(0.0)));
    stream_ = std::make_unique<listening::Stream>(std::move(plan), wanted_of(asked));
  }

  py::dict push(const Samples& samples, py::object progress) {
    Watch watch(std::move(progress));
    const std::span<const float> block(samples.data(), static_cast<std::size_t>(samples.size()));
    work([&] { stream_->push(block, std::ref(watch)); });
    const std::vector<listening::Row> rows = stream_->listening().rows(given_rows_);
    const spectrum::BandLevels* levels = stream_->listening().levels();
    py::dict dictionary;
    dictionary["rows"] = rows_of(rows, stream_->plan());
    dictionary["levels"] = dictionary_of(levels, stream_->plan(), given_intervals_);
    given_rows_ += rows.size();
    if (levels != nullptr) given_intervals_ = levels->begins().size();
    return dictionary;
  }

  py::dict finish() {
    Watch watch{py::none()};
    std::optional<listening::Heard> heard;
    work([&] { heard = stream_->finish(std::ref(watch)); });
    state_ = State::kOver;
    return dictionary_of(*heard, stream_->plan(), given_rows_, given_intervals_);
  }

  [[nodiscard]] py::dict settings() const { return settings_of(stream_->plan()); }

 private:
  enum class State : std::uint8_t { kWaits, kWorks, kBroken, kOver };

  /// Without Python: what throws leaves the stream broken, and while it works another thread may not use it.
  void work(const std::function<void()>& what) {
    if (state_ == State::kWorks) throw std::runtime_error("push(): another thread is in it");
    if (state_ == State::kBroken) throw std::runtime_error("push() was interrupted: begin again with a new object");
    if (state_ == State::kOver) throw std::runtime_error("finish() was called: begin again with a new object");
    state_ = State::kWorks;
    try {
      const py::gil_scoped_release without_python;
      what();
    } catch (...) {
      state_ = State::kBroken;
      throw;
    }
    state_ = State::kWaits;
  }

  std::unique_ptr<listening::Stream> stream_;
  State state_ = State::kWaits;
  std::size_t given_rows_ = 0;
  std::size_t given_intervals_ = 0;
};

/// begin and end, s; low and high, Hz, 0 where not given; channel or 0; file or ""; offset in the file, s, or nothing
using Selected = std::tuple<double, double, double, double, int, std::filesystem::path, std::optional<double>>;

py::list selections(const std::filesystem::path& path) {
  const annotation::SelectionTable table = [&] {
    const py::gil_scoped_release without_python;
    return annotation::read_selection_table(path);
  }();
  py::list selected;
  for (const annotation::Selection& s : table.selections)
    selected.append(py::make_tuple(s.begin_s, s.end_s, s.low_hz, s.high_hz, s.names_channel ? s.channel : 0, text_of(s.begin_file),
                                   s.names_offset ? std::optional(s.file_offset_s) : std::nullopt));
  return selected;
}

using Interval = std::pair<double, double>;
/// path, number of the first frame in the file, frames
using FilePart = std::tuple<std::filesystem::path, std::uint64_t, std::uint64_t>;

std::pair<std::vector<Interval>, std::vector<std::string>> placed(const std::vector<Selected>& selected, const std::filesystem::path& name,
                                                                  const std::vector<FilePart>& files, double rate, std::size_t channel,
                                                                  std::pair<double, double> band_hz) {
  const py::gil_scoped_release without_python;
  annotation::SelectionTable table;
  for (const auto& [begin_s, end_s, low_hz, high_hz, of_channel, file, offset_s] : selected)
    table.selections.push_back({.begin_s = begin_s,
                                .end_s = end_s,
                                .low_hz = low_hz,
                                .high_hz = high_hz,
                                .channel = of_channel,
                                .begin_file = file.string(),
                                .file_offset_s = offset_s.value_or(0.0),
                                .values = {},
                                .names_channel = of_channel > 0,
                                .names_offset = offset_s.has_value()});
  std::vector<recording::Part> parts;
  for (const auto& [path, first_frame, frames] : files) {
    recording::Part part;
    part.path = path;
    part.format.sample_rate = Hertz{rate};
    part.first_frame = first_frame;
    part.frames = frames;
    parts.push_back(std::move(part));
  }
  const recording::Sequence sequence = recording::Sequence::of_parts(std::move(parts));
  const listening::Truth truth =
      listening::truth_of(table, name.string(),
                          {.sequence = sequence, .channel = channel, .band = {.low = Hertz{band_hz.first}, .high = Hertz{band_hz.second}}});
  std::vector<Interval> intervals;
  for (const annotation::Interval& interval : truth.intervals) intervals.emplace_back(interval.begin_s, interval.end_s);
  return {intervals, printable(truth.remarks)};
}

std::vector<annotation::Interval> intervals_of(const std::vector<Interval>& pairs) {
  std::vector<annotation::Interval> intervals;
  for (const auto& [begin_s, end_s] : pairs) intervals.push_back({begin_s, end_s});
  return intervals;
}

py::dict score(const std::vector<Interval>& truth, const std::vector<Interval>& found, double tolerance_s, double listened_s) {
  checked("tolerance_s", tolerance_s, listening::kTolerances_s);
  const annotation::Score score = [&] {
    const py::gil_scoped_release without_python;
    return annotation::score(intervals_of(truth), intervals_of(found), tolerance_s, listened_s / 3600.0);
  }();
  using py::literals::operator""_a;
  return py::dict("selections"_a = score.truths, "detections"_a = score.detections, "hits"_a = score.hits, "misses"_a = score.misses(),
                  "false_alarms"_a = score.false_alarms(), "recall"_a = score.recall(), "precision"_a = score.precision(),
                  "false_alarms_per_hour"_a = score.false_alarms_per_hour());
}

}  // namespace

void add_listening(py::module_& module) {
  py::class_<Asked>(module, "Listening")
      .def(py::init([](std::string preset, std::optional<std::pair<double, double>> band, std::optional<double> threshold_db,
                       std::int64_t channel, std::optional<std::filesystem::path> calibration, std::optional<std::string> calibration_text,
                       std::optional<double> full_scale_db, std::optional<double> levels_interval) {
             return Asked{.preset = std::move(preset),
                          .band_hz = band,
                          .threshold_db = threshold_db,
                          .channel = channel,
                          .calibration = std::move(calibration),
                          .calibration_text = std::move(calibration_text),
                          .full_scale_db = full_scale_db,
                          .levels_interval_s = levels_interval};
           }),
           py::kw_only(), py::arg("preset"), py::arg("band"), py::arg("threshold_db"), py::arg("channel"), py::arg("calibration"),
           py::arg("calibration_text"), py::arg("full_scale_db"), py::arg("levels_interval"));
  module.def("listen_to_files", &listen_to_files, py::kw_only(), py::arg("files"), py::arg("begin"), py::arg("time_format"),
             py::arg("asked"), py::arg("progress"));
  py::class_<SoundStream>(module, "SoundStream")
      .def(py::init<double, std::int64_t, double, const std::optional<std::string>&, Asked>(), py::kw_only(), py::arg("rate"),
           py::arg("bits"), py::arg("largest_magnitude"), py::arg("begin"), py::arg("asked"))
      .def("push", &SoundStream::push, py::arg("samples").noconvert(), py::arg("progress"))
      .def("finish", &SoundStream::finish)
      .def_property_readonly("settings", &SoundStream::settings);
  module.def("selections", &selections, py::arg("path"));
  module.def("placed", &placed, py::kw_only(), py::arg("selected"), py::arg("name"), py::arg("files"), py::arg("rate"), py::arg("channel"),
             py::arg("band"));
  module.def(
      "printable", [](const std::filesystem::path& path) { return host::printable(path.string()); }, py::arg("path"));
  module.def("score", &score, py::kw_only(), py::arg("truth"), py::arg("found"), py::arg("tolerance_s"), py::arg("listened_s"));
}

}  // namespace earshot::python
