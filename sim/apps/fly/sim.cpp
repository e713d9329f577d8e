// earshot-sim: the ocean, the vehicle and the truth, in lock-step with earshotd.

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <ctime>
#include <exception>
#include <filesystem>
#include <iostream>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "firmware/boards/linux/waiting.hpp"
#include "firmware/core/random.hpp"
#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/file/folder_lock.hpp"
#include "firmware/host/file/output_file.hpp"
#include "firmware/host/mission/mission_file.hpp"
#include "firmware/host/mission/ports/flight_needs.hpp"
#include "firmware/host/mission/ports/lock_buses.hpp"
#include "firmware/host/mission/ports/port_override.hpp"
#include "firmware/host/program/run.hpp"
#include "firmware/host/program/signals.hpp"
#include "firmware/host/text/utc.hpp"
#include "sim/apps/fly/autopilot_bus.hpp"
#include "sim/apps/fly/flight_folder.hpp"
#include "sim/apps/fly/flight_plan.hpp"
#include "sim/apps/fly/flight_record.hpp"
#include "sim/apps/fly/hearing/hear_option.hpp"
#include "sim/apps/fly/lock_step.hpp"
#include "sim/apps/fly/speed_option.hpp"
#include "sim/link/session.hpp"
#include "sim/link/simulator_end.hpp"
#include "sim/search/episode/episode.hpp"
#include "sim/search/scenario/placement.hpp"
#include "sim/search/scenario/world.hpp"
#include "sim/sonar/sonar_field.hpp"

namespace {

using namespace earshot;
using namespace earshot::fly;

constexpr std::chrono::seconds kPatience{20};
/// For one whose microcontroller is emulated, on a machine that has other things to do: arming takes it a minute, a decision some seconds.
constexpr std::chrono::seconds kSlowPatience{900};
constexpr std::chrono::seconds kSlowAnswerPatience{120};

using program::kLost;
using program::stop_requested;

struct Options {
  std::filesystem::path environment;
  std::filesystem::path mission;
  std::optional<std::filesystem::path> vehicle;
  std::filesystem::path out = "out";
  std::uint64_t seed = 1;
  std::string source = "changing";
  double speed = 0.0;
  std::uint32_t domain = link::kLowestDomain;
  std::optional<link::RunId> run;
  host::PortOverride ports;
  std::uint32_t wait_for_runtime_s = 0;
  bool slow_runtime = false;
  bool ignore_source = false;
  std::optional<double> battery_percent;
  std::optional<std::string> hear;
};

void declare(program::CommandLine& line, Options& o) {
  line.option("--environment", &o.environment, "ocean, source and noise (TOML)").required();
  line.option("--mission", &o.mission, "mission file that earshotd flies (TOML): area, depth, speed, bus").required();
  line.option("--vehicle", &o.vehicle, "the vehicle's configuration (TOML) that earshotd judges the mission by; default: none");
  line.option("--out", &o.out, "folder for track.csv, snr.csv and summary.json, made if it is missing").shows_default();
  line.option("--seed", &o.seed, "where source and vehicle start, and what the conditions draw")
      .from(0, std::numeric_limits<std::int64_t>::max())
      .shows_default();
  line.option("--source", &o.source, "changing: drawn with the seed, uniform in the mission's area; fixed: where the environment has it")
      .one_of({"changing", "fixed"})
      .shows_default();
  line.option("--speed", &o.speed, "simulated seconds per second; 0: as fast as it goes")
      .checked(fly::speed_complaint, fly::kSpeedsAllowed)
      .shows_default();
  line.option("--domain", &o.domain, "DDS domain in which earshotd listens")
      .from(link::kLowestDomain, link::kHighestDomain)
      .shows_default();
  line.option("--run", &o.run, "number that distinguishes this run from others in the domain; default: drawn")
      .from(1, std::numeric_limits<std::int64_t>::max());
  line.option(
          "--bus", &o.ports.bus,
          "instead of the mission's ports: all over LCM, all over CAN, or navigation over CAN and the rest over LCM; not a hydrophone's")
      .one_of({"lcm", "can", "mixed"});
  line.option("--lcm-url", &o.ports.lcm_url, "address of every LCM port but a hydrophone's instead of the mission's");
  line.option("--hydrophone-url", &o.ports.hydrophone_url, "address of the hydrophone's port instead of the mission's");
  line.option("--hear", &o.hear, fly::kHearHelp).checked(fly::hear_complaint, fly::kHearsAllowed);
  line.option("--battery-percent", &o.battery_percent, fly::kBatteryHelp).between(0.0, 100.0);
  line.option("--can-interface", &o.ports.can_interface, "interface of every CAN port instead of the mission's");
  line.flag("--slow-runtime", &o.slow_runtime,
            "wait a quarter of an hour for earshotd, and two minutes for its answers: an emulator decides");
  line.option("--wait-for-runtime", &o.wait_for_runtime_s,
              "how many seconds to wait for the return of an earshotd that is lost in mid-flight (it goes on with --resume); 0: the flight "
              "ends then")
      .from(0, 86'400)
      .shows_default();
  line.flag("--ignore-source", &o.ignore_source, "fly on to the last step even when the source is found (benchmarks)");
}

/// The furthest that a source can be heard from within the area, and a little more.
Meters longest_range(const search::SearchSettings& settings, const search::Conditions& conditions) {
  const Rectangle& area = settings.domain;
  const NorthEast source = settings.source;
  const bool is_drawn = settings.placement == search::SourcePlacement::kChanging;
  if (is_drawn || conditions.sources > 1 || conditions.source_speed.value > 0.0)
    return range_between(area.south_west, area.north_east) + Meters{100.0};
  const double north = std::max(area.north_east.north.value - source.north.value, source.north.value - area.south_west.north.value);
  const double east = std::max(area.north_east.east.value - source.east.value, source.east.value - area.south_west.east.value);
  return length_of({Meters{north}, Meters{east}}) + Meters{100.0};
}

/// Where a flight begins.
struct Places {
  NorthEast source;
  vehicle::State start;
};

/// Drawn as an episode of training draws them.
Places places_of(const search::World& world, const config::Mission& mission, std::uint64_t seed) {
  const search::World calm(world.settings, world.expected());  // of the same places; where sources are several it names the first
  Pcg32 random(seed);
  search::Episode episode;
  const policy::ObservationModel sees_nothing;
  const policy::OceanTables no_oceans;
  episode.start(calm, sees_nothing, no_oceans, random);
  return {.source = episode.source(),
          .start = {.position = episode.position(), .depth = mission.search_depth, .heading = Radians{0.0}, .speed = mission.search_speed}};
}

void write_curve(const std::filesystem::path& path, const sonar::SnrCurve& snr) {
  std::string text = "range_m,snr_db\n";
  for (std::size_t i = 0; i < snr.samples_db().size(); ++i) {
    text += std::to_string(static_cast<double>(i) * snr.range_step().value) + "," + std::to_string(snr.samples_db()[i]) + "\n";
  }
  host::write_whole(path, text);
}

/// The hydrophone's bus and what goes over it, in a flight that hears.
struct Hearing {
  hydrophone::HydrophoneBus bus;
  SoundSetup setup;

  Hearing(const Options& o, const FlightPlan& plan)
      : bus(hydrophone_url(plan.mission)),
        setup{.listening = *plan.mission.hearing,
              .calls = calls_of(recording_of(*o.hear), plan.scenario.conditions, plan.scenario.environment.source.frequency,
                                *plan.mission.hearing),
              .noise_levels = {plan.scenario.environment.noise_level},
              .conditions = plan.scenario.conditions.sound,
              .bus = bus,
              .seed = o.seed} {
    for (const ocean::Environment& other : plan.scenario.other_oceans) setup.noise_levels.push_back(other.noise_level);
  }
  Hearing(const Hearing&) = delete;
  Hearing& operator=(const Hearing&) = delete;

 private:
  static std::string hydrophone_url(const host::MissionFile& mission) {
    const auto port = std::ranges::find_if(mission.ports, [](const host::PortSettings& p) { return p.roles.has(host::Role::kHydrophone); });
    return port->address;
  }
};

nlohmann::ordered_json hearing_of(const Options& o, const FlightResult& result) {
  const HearingRecord& record = result.sound->record();
  return {{"sound", *o.hear},
          {"search_began_s", (result.search_began - Time{}).to_seconds()},
          {"looks", record.measurements()},
          {"looks_too_faint", record.too_faint()},
          {"blocks_lost", result.sound->lost_blocks()}};
}

/// "2026-11-22 15:04:05": when the flight was simulated.
std::string utc_now() {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return host::date_and_time(Time{std::chrono::duration_cast<std::chrono::microseconds>(now).count()});
}

/// The mission's origin, where its north-east plane has its zero.
nlohmann::ordered_json origin_of(const n2k::LocalPlane& plane) {
  const Result<n2k::Geographic> origin = plane.to_geographic({});
  if (!origin.ok()) return nullptr;
  return {{"latitude_deg", origin.value().latitude_deg}, {"longitude_deg", origin.value().longitude_deg}};
}

nlohmann::ordered_json summary_of(const Options& o, const FlightPlan& plan, const FlightResult& result, const Score& score,
                                  NorthEast source, const vehicle::State& start) {
  const config::Mission& mission = plan.mission.mission;
  const auto place = [](NorthEast p) { return nlohmann::ordered_json{{"north_m", p.north.value}, {"east_m", p.east.value}}; };
  const Rectangle& area = mission.operating_area;
  nlohmann::ordered_json summary{{"found", result.found},
                                 {"reward", score.reward()},
                                 {"steps", score.steps()},
                                 {"distance_m", score.distance().value},
                                 {"detections", score.detections()},
                                 {"sim_time_s", (result.last_tick - Time{}).to_seconds()},
                                 {"wall_time_s", result.wall_time_s},
                                 {"flown_utc", utc_now()},
                                 {"seed", o.seed},
                                 {"end_reason", result.end_reason},
                                 {"ended_by", ending_rule_to_json(result.ending_rule)},
                                 {"environment", o.environment.string()},
                                 {"mission", o.mission.string()},
                                 {"source", place(source)},
                                 {"source_is_fixed", o.source == "fixed"},
                                 {"start", place(start.position)},
                                 {"end", place(result.end.position)},
                                 {"area", {{"south_west", place(area.south_west)}, {"north_east", place(area.north_east)}}},
                                 {"origin", origin_of(plan.mission.plane)},
                                 {"source_frequency_hz", plan.scenario.environment.source.frequency.value},
                                 {"depth_m", mission.search_depth.value},
                                 {"speed_mps", mission.search_speed.value},
                                 {"step_length_m", mission.step_length.value},
                                 {"max_steps", mission.max_steps},
                                 {"detection_threshold_db", mission.detection_threshold.value}};
  summary.update(result.account.to_json());
  if (result.battery) summary["battery_percent"] = result.battery->percent;
  if (result.sound) summary["hearing"] = hearing_of(o, result);
  return summary;
}

/// Each of a flight's files is kept whatever becomes of the others.
template <class Work>
bool succeeds(Work work) {
  try {
    work();
    return true;
  } catch (const std::exception& e) {
    std::cerr << "earshot-sim: " << e.what() << "\n";
    return false;
  }
}

/// Nothing: it is not simulated. @throws host::BadInput when the mission does not say what a kilometre takes of it
std::optional<vehicle::Battery> battery_of(const Options& o, const config::Mission& mission) {
  if (!o.battery_percent) return std::nullopt;
  require_known_consumption(mission, o.mission);
  return vehicle::Battery{.percent = *o.battery_percent, .percent_per_km = mission.safety.vehicle.battery_percent_per_km};
}

bool brings_bearings_at_sea(const host::PortSettings& port) {
  return port.kind == host::PortKind::kLcm && port.roles.has(host::Role::kSnr);
}

int simulate(const Options& o) {
  FlightPlan plan = load_flight_plan(o.mission, o.environment, o.vehicle);
  require_left_alone(plan, o.mission, recording_of(o.hear.value_or(kSynthetic)), o.out);
  host::override_ports(plan.mission, o.ports);
  if (o.hear) host::require_hydrophone(plan.mission, o.mission);
  if (plan.scenario.conditions.bearing && std::ranges::none_of(plan.mission.ports, brings_bearings_at_sea))
    throw host::BadInput(o.environment.string() +
                         ": conditions.bearing_deg: at sea a bearing comes over LCM, CAN carries none, and no LCM port of " +
                         o.mission.string() + " has the role \"snr\"");
  if (o.hear && o.wait_for_runtime_s > 0)
    throw host::BadInput("--wait-for-runtime: not with --hear: what a detector has learnt of the noise is in no journal");
  plan.search.placement = search::placement_named(o.source).value_or(plan.search.placement);
  const auto& [file, scenario, settings] = plan;
  const search::World world = search::assemble(scenario, settings, file.mission.search_depth, longest_range(settings, scenario.conditions));
  auto [source, start] = places_of(world, file.mission, o.seed);
  if (o.hear) start.speed = {};  // it lies there and listens until it knows the noise
  const FlightSetup setup{.world = world,
                          .source = source,
                          .found_within = settings.step_length,
                          .may_be_found = !o.ignore_source,
                          .vehicle = {},
                          .battery = battery_of(o, file.mission),
                          .seed = o.seed,
                          .answer_patience = o.slow_runtime ? kSlowAnswerPatience : fly::kAnswerPatience,
                          .wait_for_runtime = std::chrono::seconds(o.wait_for_runtime_s),
                          .speed = o.speed};

  const std::vector<host::BusLock> locks = host::lock_buses(file, host::BusPlace::kSimulator);
  AutopilotBus bus(file);
  std::optional<Hearing> hearing;
  if (o.hear) hearing.emplace(o, plan);
  program::stop_on_signals();  // up to here nothing is under way that would have to end in order
  link::SimulatorEnd link(o.domain, o.run.value_or(link::new_run()));
  const board::Waited waited = board::wait_for(
      "earshot-sim", "an earshotd in DDS domain " + std::to_string(o.domain), o.slow_runtime ? kSlowPatience : kPatience,
      [&link](std::chrono::milliseconds most) { return link.wait_for_runtime(most); },
      o.run ? board::Notice::kNone : board::Notice::kGiven);
  if (waited != board::Waited::kCame) return waited == board::Waited::kStopped ? program::kStopped : kLost;

  // Only now that both sides have taken their input: a refused policy leaves no half of a flight behind.
  std::filesystem::create_directories(o.out);
  const host::FileDescriptor folder = host::lock_folder(o.out);
  remove_results(o.out);
  std::optional<TrackFile> track;
  const bool has_files = succeeds([&] {
    write_curve(o.out / "snr.csv", world.expected());
    track.emplace(o.out / "track.csv");
  });
  if (!has_files) return kLost;  // a full disk is not the input's fault
  Score score(settings);
  const FlightResult result =
      fly_in_lock_step({setup, bus, link, *track, score, hearing ? &hearing->setup : nullptr}, start, stop_requested);
  const bool has_track = succeeds([&] {
    track->finish();
    if (result.sound) result.sound->record().write(o.out);
  });
  const bool has_summary =
      succeeds([&] { host::write_whole(o.out / "summary.json", summary_of(o, plan, result, score, source, start).dump(2) + "\n"); });
  if (link.strangers() > 0)
    std::cerr << "earshot-sim: " << link.strangers() << " answers of another earshotd in DDS domain " << o.domain << " were ignored\n";
  if (result.failure.empty()) return has_track && has_summary ? 0 : kLost;
  std::cerr << "earshot-sim: " << result.failure << " at " << result.last_tick.us / 1'000'000
            << " s; track up to then: " << (o.out / "track.csv").string() << "\n";
  return kLost;
}

}  // namespace

int main(int argc, char** argv) {
  program::CommandLine line(
      "earshot-sim",
      "earshot-sim plays the ocean and the vehicle for one search, in lock-step with an earshotd started with --simulation.\n"
      "Exit status: 0 flown, 2 bad input, 3 earshotd, the bus or a file was lost, 130 stopped before the start.\n"
      "(earshot fly starts both.)");
  Options options;
  declare(line, options);
  return program::run(line, argc, argv, [&] { return simulate(options); });
}
