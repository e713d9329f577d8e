// earshot emulate: the devices of a vehicle on a CAN bus.

#include <cstdint>
#include <filesystem>
#include <limits>
#include <numbers>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include "firmware/core/random.hpp"
#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/file/distinct_files.hpp"
#include "firmware/host/file/output_file.hpp"
#include "firmware/host/file/printable.hpp"
#include "firmware/host/file/shipped.hpp"
#include "firmware/host/mission/mission_file.hpp"
#include "firmware/host/program/run.hpp"
#include "firmware/host/program/signals.hpp"
#include "firmware/host/text/numbers.hpp"
#include "hil/nodes/bus_connection.hpp"
#include "hil/nodes/emulated_vehicle.hpp"
#include "hil/nodes/scaled_clock.hpp"
#include "hil/nodes/vehicle/track_file.hpp"
#include "hil/nodes/vehicle_events.hpp"
#include "sim/ocean/file/environment_file.hpp"
#include "sim/sonar/sonar_field.hpp"

namespace {

using namespace earshot;

struct Options {
  std::filesystem::path mission;
  std::optional<std::filesystem::path> environment;
  std::optional<std::string> interface;
  std::vector<double> source;
  std::vector<double> start;
  std::uint64_t seed = 1;
  double speed = 1.0;
  std::optional<double> duration_s;
  std::optional<double> variation_deg;
  std::vector<std::string> without;
  std::optional<std::filesystem::path> track;
};

void declare(program::CommandLine& line, Options& o) {
  line.option("--mission", &o.mission, "mission file that earshotd flies (TOML): origin, area, depth, speed, CAN interface").required();
  line.option("--environment", &o.environment,
              "ocean, source level and noise (TOML), whose sound propagation gives the hydrophone's SNR, and whose sea floor the "
              "altitude; default: munk_flat.toml");
  line.option("--interface", &o.interface, "CAN interface instead of that of the mission's first CAN port");
  line.option("--source", &o.source, "where the source is, metres north and east of the mission's origin; default: drawn in its area")
      .separated_by(',')
      .takes(2, 2);
  line.option("--start", &o.start, "where the vehicle is, likewise").separated_by(',').takes(2, 2);
  line.option("--seed", &o.seed, "draws what is not given, and the devices' unique numbers")
      .from(0, std::numeric_limits<std::int64_t>::max())
      .shows_default();
  line.option("--speed", &o.speed, "seconds of the vehicle's time per second; earshotd must be given the same")
      .between(0.01, 100.0)
      .shows_default();
  line.option("--duration", &o.duration_s, "seconds of the vehicle's time until it ends; default: it goes on until Ctrl-C").positive();
  line.option("--variation", &o.variation_deg, "degrees, east positive: the compass is a magnetic one; default: a gyrocompass")
      .between(-180.0, 180.0);
  line.option("--track", &o.track, "file (CSV) that each second's place of the vehicle is added to");
  line.option(
          "--without", &o.without,
          "devices to leave out, because they are there as hardware: " +
              [] {
                std::string names;
                for (const std::string_view name : hil::kDeviceNames) names += (names.empty() ? "" : ", ") + std::string(name);
                return names;
              }())
      .separated_by(',')
      .one_of({std::begin(hil::kDeviceNames), std::end(hil::kDeviceNames)});
}

std::string interface_of(const Options& o, const host::MissionFile& mission) {
  if (o.interface) return *o.interface;
  const std::vector<std::string> interfaces = host::addresses_of(mission.ports, host::PortKind::kCan);
  if (interfaces.empty()) throw host::BadInput(o.mission.string() + ": port: no port is of the kind \"can\"; --interface names a bus");
  return interfaces.front();
}

NorthEast place_of(const std::vector<double>& given, const char* option, const Rectangle& area, Pcg32& random) {
  const NorthEast size = area.north_east - area.south_west;
  const NorthEast drawn = area.south_west + NorthEast{random.uniform_double() * size.north, random.uniform_double() * size.east};
  if (given.empty()) return drawn;
  const NorthEast place{Meters{given[0]}, Meters{given[1]}};
  if (!area.contains(place)) throw host::BadInput(std::string(option) + ": must lie in the mission's [area]");
  return place;
}

/// As the parabolic equation has it, out to the far corner of the area.
hil::SnrOfRange snr_of(const ocean::Environment& environment, const config::Mission& mission) {
  const Meters furthest = range_between(mission.operating_area.south_west, mission.operating_area.north_east);
  return [curve = sonar::compute_snr_curve(environment, mission.search_depth, furthest)](Meters range) { return curve.at(range); };
}

/// With the key of the mission that earshotd flies, for that mission and the vehicle that it names.
hil::MakeMark mark_for(const host::MissionFile& file) {
  if (!file.command_key) return {};
  return [key = *file.command_key, meant = file.challenge](const messages::OperatorCommand& command,
                                                           const messages::PublishedChallenge& published) {
    const bool is_meant = published.challenge.vehicle == meant.vehicle && published.challenge.mission == meant.mission;
    return is_meant && key.verifies(published) ? std::optional(key.mark_of(command, published.challenge)) : std::nullopt;
  };
}

hil::VehicleSetup setup_of(const Options& o, const host::MissionFile& file, const ocean::Environment& environment) {
  const config::Mission& mission = file.mission;
  Pcg32 random(o.seed);
  hil::VehicleSetup setup;
  setup.source.position = place_of(o.source, "--source", mission.operating_area, random);
  setup.start = {.position = place_of(o.start, "--start", mission.operating_area, random),
                 .depth = mission.search_depth,
                 .heading = Radians{0.0},
                 .speed = MetersPerSecond{0.0}};
  setup.source.snr = snr_of(environment, mission);
  setup.sea_floor.depth = environment.seabed.depth;
  setup.plane = file.plane;
  setup.found_within = mission.step_length;
  setup.utc = hil::ScaledClock::utc;
  // A mission may name the devices that it reads, so that their NAMEs are the seed's; two that start with one seed are two operators.
  constexpr std::uint64_t kDevices = 1;
  setup.first_number = Pcg32(o.seed, kDevices).next() % 0x1FFF00U;
  setup.issuer = 1 + Pcg32(o.seed, static_cast<std::uint64_t>(hil::ScaledClock::utc().us)).next() % 0xFFFFU;
  if (o.variation_deg) setup.magnetic_field = hil::MagneticField{Radians{*o.variation_deg * std::numbers::pi / 180.0}};
  setup.without = o.without;
  setup.mark = mark_for(file);
  return setup;
}

void introduce(const std::string& interface, const hil::VehicleSetup& setup, const hil::EmulatedVehicle& vehicle, double speed) {
  std::ostream& out = program::print();
  out << "a vehicle on " << host::printable(interface) << ", ";
  if (speed == 1.0) {
    out << "in real time:";
  } else {
    out << speed << " times as fast as at sea:";
  }
  for (const std::string_view name : vehicle.devices()) out << (name == vehicle.devices().front() ? " " : ", ") << name;
  out << "\nit lies at " << hil::in_kilometres(setup.start.position) << ", the source at " << hil::in_kilometres(setup.source.position)
      << ", where its SNR is " << host::decimals(setup.source.snr(vehicle.range()).value, 1) << " dB\n"
      << "waiting for Earshot on that bus, as long as it takes; Ctrl-C ends it\n"
      << std::flush;
}

constexpr host::OutputKind kTrackOutput{"a track of earshot emulate", {hil::kTrackHeader, {}}};

/// A track goes on behind what its file holds.
void require_track(const Options& o, const ocean::Environment& environment) {
  if (!o.track) return;
  host::DistinctFiles files;
  files.read("--mission", o.mission);
  files.read("a file of --environment", environment.files);
  files.write("--track", *o.track);
  host::require_writable(*o.track, kTrackOutput, host::Replace::kOwnKind, "name another file");
}

int emulate(const Options& o) {
  const host::MissionFile mission = host::load_mission(o.mission);
  const std::string interface = interface_of(o, mission);
  const ocean::Environment environment =
      ocean::load_environment(o.environment ? *o.environment : host::shipped("sim/ocean/environments/munk_flat.toml"));
  require_track(o, environment);
  const hil::VehicleSetup setup = setup_of(o, mission, environment);
  hil::EmulatedVehicle vehicle(setup);
  const hil::ScaledClock clock(o.speed);
  hil::BusConnection bus(interface, vehicle, clock);
  std::optional<hil::TrackFile> track;
  if (o.track) track.emplace(*o.track);
  program::stop_on_signals();
  introduce(interface, setup, vehicle, o.speed);
  const Time began = clock.now();
  hil::VehicleEvents events(vehicle, began);
  bool is_up = true;
  while (!program::stop_requested && !(o.duration_s && (clock.now() - began).to_seconds() >= *o.duration_s)) {
    bus.turn();
    if (track) track->note(clock.now(), hil::ScaledClock::host_now(), vehicle.state());
    if (bus.is_up() != is_up) program::print() << interface << (bus.is_up() ? " is up again\n" : " is down; tried again once a second\n");
    is_up = bus.is_up();
    for (const std::string& line : events.lines(clock.now())) program::print() << line << "\n";
    program::print() << std::flush;
  }
  program::print() << events.summary(clock.now()) << "; " << bus.sent() << " frames sent, " << bus.received() << " received, " << bus.lost()
                   << " lost\n";
  return program::kDone;
}

}  // namespace

int main(int argc, char** argv) {
  program::CommandLine line("earshot emulate",
                            "A vehicle's devices on a CAN bus (NMEA 2000), for an earshotd without its vehicle: compass, speed log, depth\n"
                            "sensor, altimeter, inertial navigation, battery, autopilot, a hydrophone that hears a hidden source, and an\n"
                            "operator who sends START, and COMPLETE at the source.");
  Options options;
  declare(line, options);
  return program::run(line, argc, argv, [&] { return emulate(options); });
}
