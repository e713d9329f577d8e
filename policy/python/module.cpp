// earshot._core: the search as Python sees it. Every argument is checked here; earshot/_core.pyi says what a call takes and gives.
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "firmware/host/toml/table_reader.hpp"
#include "policy/python/belief/belief_module.hpp"
#include "policy/python/boundary/errors.hpp"
#include "policy/python/boundary/given_array.hpp"
#include "policy/python/evaluation/evaluation_module.hpp"
#include "policy/python/journal_module.hpp"
#include "policy/python/listening_module.hpp"
#include "policy/python/ocean/field_module.hpp"
#include "policy/python/ocean/library_module.hpp"
#include "policy/python/ocean/model_files_module.hpp"
#include "policy/python/ocean/ocean_module.hpp"
#include "policy/python/policy_module.hpp"
#include "policy/python/replayable_episode.hpp"
#include "policy/python/search_problem.hpp"
#include "sim/search/streams.hpp"

namespace {

namespace py = pybind11;
using namespace earshot;
using search::EpisodeEnd;
using Running = python::ReplayableEpisode;

using Floats = py::array_t<float, py::array::c_style>;
using Actions = python::GivenArray<std::int64_t, py::array::forcecast>;  // of whole_numbers() only: it truncates
using Place = std::pair<double, double>;                                 // north, east

std::span<float> span_of(Floats& array) {
  return {array.mutable_data(), static_cast<std::size_t>(array.size())};
}

Actions whole_numbers(const py::array& actions) {
  const char kind = actions.dtype().kind();
  if (kind == 'i' || kind == 'u') return Actions(actions);
  throw py::type_error("actions: must be whole numbers, not " + std::string(py::str(actions.dtype())));
}

std::size_t checked_action(std::int64_t action, std::size_t count) {
  if (action >= 0 && static_cast<std::size_t>(action) < count) return static_cast<std::size_t>(action);
  throw py::value_error("action " + std::to_string(action) + ": must be 0 to " + std::to_string(count - 1));
}

NorthEast place_of(Place place) {
  return {Meters{place.first}, Meters{place.second}};
}

NorthEast checked_place(const char* name, Place place, const Rectangle& domain) {
  const NorthEast position = place_of(place);
  if (domain.contains(position)) return position;  // false for NaN
  throw py::value_error(std::string(name) + ": must lie in the search domain");
}

Place pair_of(NorthEast place) {
  return {place.north.value, place.east.value};
}

/// Keys of an info, made once: making them would cost as much as the rest of a step.
struct InfoKeys {
  py::str snr_db{"snr_db"};
  py::str too_faint{"too_faint"};
  py::str position_m{"position_m"};
  py::str source_m{"source_m"};
  py::str found{"found"};
  py::str detections{"detections"};
};

py::tuple tuple_of(const python::EpisodeHistory& history) {
  py::object places = py::none();
  if (history.places) places = py::make_tuple(pair_of(history.places->position), pair_of(history.places->source));
  return py::make_tuple(history.random.state, history.random.increment, history.is_started, places, py::bytes(history.actions));
}

python::EpisodeHistory history_of(const py::tuple& tuple) {
  if (tuple.size() != 5) throw host::BadInput("not an episode that was pickled");
  python::EpisodeHistory history{.random = {.state = tuple[0].cast<std::uint64_t>(), .increment = tuple[1].cast<std::uint64_t>()},
                                 .is_started = tuple[2].cast<bool>(),
                                 .places = std::nullopt,
                                 .actions = tuple[4].cast<py::bytes>()};
  if (tuple[3].is_none()) return history;
  const auto [position, source] = tuple[3].cast<std::pair<Place, Place>>();
  history.places = {place_of(position), place_of(source)};
  return history;
}

/// Episodes stepped together.
class Episodes {
 public:
  Episodes(std::shared_ptr<const python::SearchProblem> problem, std::size_t count) : problem_(std::move(problem)), running_(count) {
    if (count < 1) throw py::value_error("count: must be 1 or more");
    for (std::size_t i = 0; i < count; ++i) running_[i].seed(search::training_random(0, i));
  }

  /// The search, and the state of each episode.
  [[nodiscard]] py::tuple state() const {
    py::list states;
    for (const Running& running : running_) states.append(tuple_of(running.history()));
    return py::make_tuple(std::const_pointer_cast<python::SearchProblem>(problem_), states);
  }

  static Episodes from_state(const py::tuple& state) {
    if (state.size() != 2) throw host::BadInput("not episodes that were pickled");
    const auto states = state[1].cast<std::vector<py::tuple>>();
    Episodes episodes(state[0].cast<std::shared_ptr<python::SearchProblem>>(), states.size());
    for (std::size_t i = 0; i < states.size(); ++i) episodes.running_[i] = Running::from(*episodes.problem_, history_of(states[i]));
    return episodes;
  }

  /// Draws the next search; a seed restarts the random numbers first.
  void start(std::size_t i, std::optional<std::uint64_t> seed) {
    Running& running = at(i);
    if (seed) running.seed(search::training_random(*seed, 0));
    running.start(*problem_);
  }

  void start_at(std::size_t i, Place position, Place source) {
    const Rectangle& domain = problem_->world().settings.domain;
    const NorthEast from = checked_place("position_m", position, domain);
    const NorthEast to = checked_place("source_m", source, domain);
    if (range_between(from, to) <= problem_->world().settings.step_length) {
      throw py::value_error("position_m, source_m: within a step of each other the search would be over before it begins");
    }
    at(i).start_at(*problem_, {from, to});
  }

  Floats observations() {
    check_all_started("observations()");
    Floats all(shape());
    for (std::size_t i = 0; i < running_.size(); ++i) observe(i, all);
    return all;
  }

  /// Steps episode 0.
  py::tuple step_one(std::int64_t action) {
    check_all_run();
    const std::size_t checked = checked_action(action, problem_->world().actions.size());
    const double reward = running_[0].step(*problem_, checked);
    const EpisodeEnd end = running_[0].episode().record().end;
    Floats observation(static_cast<py::ssize_t>(problem_->observation().spec.size()));
    running_[0].episode().observe(span_of(observation));
    return py::make_tuple(std::move(observation), reward, is_terminated(end), end == EpisodeEnd::kTimeLimit, info(0));
  }

  /// Steps every episode; those that end start anew at once.
  py::tuple step(const py::array& given) {
    check_all_run();
    const Actions actions = whole_numbers(given);
    if (actions.ndim() != 1 || static_cast<std::size_t>(actions.size()) != running_.size()) {
      throw py::value_error("actions: must be one for each of the " + std::to_string(running_.size()) + " environments");
    }
    for (const std::int64_t action : std::span(actions.data(), running_.size())) checked_action(action, problem_->world().actions.size());
    return step_checked(std::span(actions.data(), running_.size()));
  }

  /// What Gymnasium calls info, whole: one call from Python instead of one for each value.
  [[nodiscard]] py::dict info(std::size_t i) const {
    const search::Episode& episode = at(i).episode();
    py::dict info;
    info[keys_.snr_db] = episode.snr().value;
    info[keys_.too_faint] = episode.reception().too_faint;
    info[keys_.position_m] = pair_of(episode.position());
    info[keys_.source_m] = pair_of(episode.source());
    const search::EpisodeRecord& record = episode.record();
    if (record.end != EpisodeEnd::kRunning) {
      info[keys_.found] = record.end == EpisodeEnd::kFound;
      info[keys_.detections] = record.detections;
    }
    return info;
  }

  [[nodiscard]] Place position(std::size_t i) const { return pair_of(at(i).episode().position()); }
  [[nodiscard]] Place source(std::size_t i) const { return pair_of(at(i).episode().source()); }
  [[nodiscard]] double snr_db(std::size_t i) const { return at(i).episode().snr().value; }
  [[nodiscard]] bool is_too_faint(std::size_t i) const { return at(i).episode().reception().too_faint; }
  [[nodiscard]] py::dict record(std::size_t i) const { return dictionary_of(at(i).episode().record()); }

 private:
  static bool is_terminated(EpisodeEnd end) { return end == EpisodeEnd::kFound || end == EpisodeEnd::kLeftDomain; }
  static py::dict dictionary_of(const search::EpisodeRecord& record) {
    py::dict dictionary;
    dictionary["reward"] = record.reward;
    dictionary["steps"] = record.steps;
    dictionary["detections"] = record.detections;
    dictionary["found"] = record.end == EpisodeEnd::kFound;
    return dictionary;
  }

  [[nodiscard]] std::vector<py::ssize_t> shape() const {
    return {static_cast<py::ssize_t>(running_.size()), static_cast<py::ssize_t>(problem_->observation().spec.size())};
  }
  const Running& at(std::size_t i) const {
    if (i >= running_.size()) throw py::index_error("no environment " + std::to_string(i));
    return running_[i];
  }
  Running& at(std::size_t i) {
    static_cast<void>(std::as_const(*this).at(i));
    return running_[i];
  }
  void observe(std::size_t i, Floats& all) const {
    const std::size_t size = problem_->observation().spec.size();
    running_[i].episode().observe(span_of(all).subspan(i * size, size));
  }
  void check_all_started(const char* call) const {
    for (const Running& running : running_) {
      if (!running.is_started()) throw std::runtime_error(std::string(call) + " before reset()");
    }
  }
  void check_all_run() const {
    check_all_started("step()");
    for (const Running& running : running_) {
      if (running.episode().record().end != EpisodeEnd::kRunning) throw std::runtime_error("the episode is over: reset() before step()");
    }
  }

  py::tuple step_checked(std::span<const std::int64_t> actions) {
    const auto count = static_cast<py::ssize_t>(running_.size());
    Floats observations(shape());
    py::array_t<double> rewards(count);
    py::array_t<bool> terminated(count);
    py::array_t<bool> truncated(count);
    py::list ended;  // (index, final observation, record)
    for (std::size_t i = 0; i < running_.size(); ++i) {
      Running& running = running_[i];
      const auto index = static_cast<py::ssize_t>(i);
      rewards.mutable_at(index) = running.step(*problem_, static_cast<std::size_t>(actions[i]));
      const search::EpisodeRecord record = running.episode().record();
      terminated.mutable_at(index) = is_terminated(record.end);
      truncated.mutable_at(index) = record.end == EpisodeEnd::kTimeLimit;
      if (record.end != EpisodeEnd::kRunning) {
        Floats last(static_cast<py::ssize_t>(problem_->observation().spec.size()));
        running.episode().observe(span_of(last));
        ended.append(py::make_tuple(i, std::move(last), dictionary_of(record)));
        running.start(*problem_);
      }
      observe(i, observations);
    }
    return py::make_tuple(std::move(observations), std::move(rewards), std::move(terminated), std::move(truncated), std::move(ended));
  }

  std::shared_ptr<const python::SearchProblem> problem_;
  std::vector<Running> running_;
  InfoKeys keys_;
};

template <class Unsigned>
Unsigned checked_count(const char* name, std::int64_t value) {
  if (value >= 0 && value <= std::numeric_limits<std::uint32_t>::max()) return static_cast<Unsigned>(value);
  throw host::BadInput(std::string(name) + " = " + std::to_string(value) + ": is no such number");
}

std::shared_ptr<python::SearchProblem> make_world(std::filesystem::path environment, std::string state, std::int64_t remembered_steps,
                                                  std::string source, std::string start, std::int64_t directions, double vehicle_depth_m,
                                                  double border_width_m, std::int64_t max_steps, std::string listening,
                                                  std::int64_t listening_window_s) {
  const python::SearchProblemArguments arguments{.environment = std::move(environment),
                                                 .state = std::move(state),
                                                 .remembered_steps = checked_count<std::size_t>("remembered_steps", remembered_steps),
                                                 .source = std::move(source),
                                                 .start = std::move(start),
                                                 .direction_count = checked_count<std::size_t>("directions", directions),
                                                 .vehicle_depth = Meters{vehicle_depth_m},
                                                 .border_width = Meters{border_width_m},
                                                 .max_steps = checked_count<std::uint32_t>("max_steps", max_steps),
                                                 .listening = std::move(listening),
                                                 .listening_window_s = listening_window_s};
  const py::gil_scoped_release others_may_run;
  return std::make_shared<python::SearchProblem>(arguments);
}

py::array_t<double> snr_against_range(const python::SearchProblem& problem,
                                      const python::GivenArray<double, py::array::forcecast>& range_m) {
  py::array_t<double> snr_db(std::vector<py::ssize_t>(range_m.shape(), range_m.shape() + range_m.ndim()));
  for (py::ssize_t i = 0; i < range_m.size(); ++i)
    snr_db.mutable_data()[i] = problem.world().expected().at(Meters{range_m.data()[i]}).value;
  return snr_db;
}

Place area_of(const python::SearchProblem& problem) {
  const Rectangle& domain = problem.world().settings.domain;
  const NorthEast size = domain.north_east - domain.south_west;
  return {size.north.value, size.east.value};
}

/// What make_world() of earshot_gym/world.py takes to make this search again.
py::dict arguments_of(const python::SearchProblem& problem) {
  const python::SearchProblemArguments& arguments = problem.arguments();
  using py::literals::operator""_a;
  return py::dict("environment"_a = arguments.environment, "state"_a = arguments.state, "remembered_steps"_a = arguments.remembered_steps,
                  "source"_a = arguments.source, "start"_a = arguments.start, "directions"_a = arguments.direction_count,
                  "vehicle_depth_m"_a = arguments.vehicle_depth.value, "border_width_m"_a = arguments.border_width.value,
                  "max_steps"_a = arguments.max_steps, "listening"_a = arguments.listening,
                  "listening_window_s"_a = arguments.listening_window_s);
}

void add_world(py::module_& module) {
  module.def("environment_crc32", &python::environment_crc32, py::arg("environment"));
  py::class_<python::SearchProblem, std::shared_ptr<python::SearchProblem>>(module, "World")
      .def(py::init(&make_world), py::kw_only(), py::arg("environment"), py::arg("state"), py::arg("remembered_steps"), py::arg("source"),
           py::arg("start"), py::arg("directions"), py::arg("vehicle_depth_m"), py::arg("border_width_m"), py::arg("max_steps"),
           py::arg("listening"), py::arg("listening_window_s"))
      .def("__copy__", [](const py::object& world) { return world; })  // nothing of it ever changes
      .def(
          "__deepcopy__", [](const py::object& world, const py::dict&) { return world; }, py::arg("memo"))
      .def_property_readonly("arguments", &arguments_of)
      .def_property_readonly("environment_crc32", &python::SearchProblem::environment_crc32)
      .def_property_readonly("observation_size", [](const python::SearchProblem& problem) { return problem.observation().spec.size(); })
      .def_property_readonly("observation_names", &python::SearchProblem::observation_names)
      .def_property_readonly("action_count", [](const python::SearchProblem& problem) { return problem.world().actions.size(); })
      .def_property_readonly("max_steps", [](const python::SearchProblem& problem) { return problem.world().settings.max_steps; })
      .def_property_readonly("detection_threshold_db",
                             [](const python::SearchProblem& problem) { return problem.world().settings.detection_threshold.value; })
      .def_property_readonly("area_m", &area_of)
      .def_property_readonly("description", &python::SearchProblem::description)
      .def("snr_db", &snr_against_range, py::arg("range_m"));
}

void add_episodes(py::module_& module) {
  py::class_<Episodes>(module, "Episodes")
      .def(py::init<std::shared_ptr<python::SearchProblem>, std::size_t>(), py::arg("world"), py::arg("count"))
      .def(py::pickle([](const Episodes& episodes) { return episodes.state(); },
                      [](const py::tuple& state) { return Episodes::from_state(state); }))
      .def("__copy__", [](const Episodes& episodes) { return Episodes(episodes); })
      .def(
          "__deepcopy__", [](const Episodes& episodes, const py::dict&) { return Episodes(episodes); }, py::arg("memo"))
      .def("start", &Episodes::start, py::arg("index"), py::arg("seed") = std::nullopt)
      .def("start_at", &Episodes::start_at, py::arg("index"), py::arg("position_m"), py::arg("source_m"))
      .def("observations", &Episodes::observations)
      .def("step_one", &Episodes::step_one, py::arg("action"))
      .def("step", &Episodes::step, py::arg("actions"))
      .def("position_m", &Episodes::position, py::arg("index"))
      .def("source_m", &Episodes::source, py::arg("index"))
      .def("snr_db", &Episodes::snr_db, py::arg("index"))
      .def("is_too_faint", &Episodes::is_too_faint, py::arg("index"))
      .def("info", &Episodes::info, py::arg("index"))
      .def("record", &Episodes::record, py::arg("index"));
}

}  // namespace

PYBIND11_MODULE(_core, module) {
  python::add_errors();
  add_world(module);
  python::add_ocean(module);
  python::add_fields(module);
  python::add_model_files(module);
  python::add_libraries(module);
  python::add_belief(module);
  python::add_evaluation(module);
  python::add_journal(module);
  python::add_listening(module);
  add_episodes(module);
  python::add_policy(module);
}
