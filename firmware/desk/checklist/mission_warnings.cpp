#include "firmware/desk/checklist/mission_warnings.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <iterator>
#include <numbers>
#include <system_error>

#include "firmware/config/capacities.hpp"
#include "firmware/core/polygon.hpp"
#include "firmware/desk/checklist/budgets.hpp"
#include "firmware/desk/checklist/rule_warnings.hpp"
#include "firmware/host/file/printable.hpp"
#include "firmware/host/mission/hydrophone_chain.hpp"
#include "firmware/host/text/numbers.hpp"
#include "firmware/messages/hydrophone_block.hpp"
#include "firmware/policy/tables/ocean_tables.hpp"

namespace earshot::board {
namespace {

using Warnings = std::vector<std::string>;

void warn_if(bool is_so, Warnings& warnings, const std::string& words) {
  if (is_so) warnings.push_back(words);
}

bool has_rule_about(const config::Mission& mission, config::Condition condition) {
  return std::ranges::any_of(mission.safety.rules, [condition](const config::Rule& rule) { return rule.condition == condition; });
}

void check_limits(const config::Mission& mission, Warnings& warnings) {
  warn_if(!mission.safety.fence, warnings,
          "there is no [fence]: nothing steers the vehicle back before it leaves the area, and that ends the mission");
  warn_if(mission.safety.vehicle == config::VehicleLimits{}, warnings,
          "there is no [vehicle]: fixes are believed that only 20 m/s can explain, and the vehicle is taken to hover and to float up by "
          "itself");
  const Meters room = mission.max_depth - mission.search_depth;
  warn_if(
      room < kDepthRoom, warnings,
      host::formatted("search.depth_m is %g m above limits.max_depth_m: a vehicle that is deeper than that for 5 s is aborted; leave %g m",
                      room.value, kDepthRoom.value));
}

/// How it moves, said by its owner: by guess, or not at all.
void check_vehicle(const config::VehicleLimits& vehicle, Warnings& warnings) {
  if (vehicle == config::VehicleLimits{}) return;
  constexpr double kSteepClimb = 0.5;  // 30 degrees, steeper than a vehicle with wings or a pitch limit climbs
  const double rate_mps = vehicle.ascent_rate.value;
  const double speed_mps = vehicle.ascent_speed.value;
  warn_if(speed_mps > 0.0 && rate_mps > kSteepClimb * speed_mps, warnings,
          host::formatted(
              "vehicle.ascent_rate_mps, %g m/s, asks for a climb of %.0f degrees all the way: one that rises more slowly, and whose "
              "depth sensor fails, is ordered to stop below the surface",
              rate_mps, std::asin(std::min(rate_mps / speed_mps, 1.0)) * 180.0 / std::numbers::pi));
  warn_if(speed_mps == 0.0 && rate_mps != config::kSlowestAscent.value, warnings,
          "vehicle.ascent_rate_mps is not used: a vehicle with ascent_speed_mps = 0 floats up");
  warn_if(vehicle.max_current.value == 0.0, warnings,
          "vehicle.max_current_mps is not given: any current up to 4 m/s is thought possible, and a place that drifts by several metres a "
          "second is not noticed (place_unexplained_m)");
}

void check_steps(const config::Mission& mission, Warnings& warnings) {
  warn_if(mission.max_steps > config::kMaxBeliefMeasurements, warnings,
          host::formatted("search.max_steps, %u: a policy with a belief tries no other oceans and drifts from SNR measurement %zu on",
                          unsigned{mission.max_steps}, config::kMaxBeliefMeasurements + 1));
}

void check_time(const config::Mission& mission, Warnings& warnings) {
  const double most_s = mission.max_time.to_seconds();
  const double current_mps = mission.safety.vehicle.max_current.value;
  const bool is_over_in_still_water = seconds_for_all_steps(mission) > most_s;
  warn_if(is_over_in_still_water, warnings, "limits.max_time_s is over before all steps are taken");
  warn_if(!is_over_in_still_water && seconds_against_current(mission) > most_s, warnings,
          host::formatted(
              "limits.max_time_s, %.0f s, is over before all steps are taken against vehicle.max_current_mps, %g m/s: they take %.0f s",
              most_s, current_mps, seconds_against_current(mission)));
}

void check_battery(const config::Mission& mission, Warnings& warnings) {
  const double steps_percent = percent_for_all_steps(mission);
  const double percent = steps_percent + (mission.safety.safe_point ? percent_for_way_home(mission) : 0.0);
  if (steps_percent > 100.0) {
    warnings.push_back(host::formatted("all steps need %.0f %% of a battery", steps_percent));
  } else if (percent > 100.0) {
    warnings.push_back(host::formatted("all steps and the longest way home need %.0f %% of a battery", percent));
  }
  const bool watches_way_home = has_rule_about(mission, config::Condition::kBatteryAtHome);
  warn_if(!watches_way_home && !has_rule_about(mission, config::Condition::kBattery), warnings, "no rule watches the battery");
  warn_if(!watches_way_home && has_rule_about(mission, config::Condition::kBattery) && mission.safety.vehicle.battery_percent_per_km == 0.0,
          warnings, "vehicle.battery_percent_per_km is not given: whether the battery lasts for all steps is not known");
  warn_if(watches_way_home && mission.safety.vehicle.battery_percent_per_km == 0.0, warnings,
          "vehicle.battery_percent_per_km is not given: battery_at_home_percent counts no way home");
}

/// Twice the area of a triangle, positive where the corners are clockwise seen from above.
double turn(NorthEast a, NorthEast b, NorthEast c) {
  const NorthEast ab = b - a;
  const NorthEast ac = c - a;
  return ab.north.value * ac.east.value - ab.east.value * ac.north.value;
}

bool do_cross(NorthEast a, NorthEast b, NorthEast c, NorthEast d) {
  return turn(a, b, c) * turn(a, b, d) < 0.0 && turn(c, d, a) * turn(c, d, b) < 0.0;
}

/// Whether two polygons have any place in common.
bool do_overlap(Corners a, Corners b) {
  const auto holds_a_corner = [](Corners outer, Corners inner) {
    return std::ranges::any_of(inner, [outer](NorthEast corner) { return contains(outer, corner); });
  };
  if (holds_a_corner(a, b) || holds_a_corner(b, a)) return true;
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; j < b.size(); ++j) {
      if (do_cross(a[i], a[(i + 1) % a.size()], b[j], b[(j + 1) % b.size()])) return true;
    }
  }
  return false;
}

void check_zones(const config::Mission& mission, Warnings& warnings) {
  const Rectangle& r = mission.operating_area;
  const std::array<NorthEast, 4> area{r.south_west, NorthEast{r.north_east.north, r.south_west.east}, r.north_east,
                                      NorthEast{r.south_west.north, r.north_east.east}};
  const Corners halt = mission.safety.fence ? mission.safety.fence->halt.span() : Corners(area);
  for (std::size_t i = 0; i < mission.safety.no_surface.size(); ++i) {
    warn_if(
        !do_overlap(mission.safety.no_surface[i].span(), halt), warnings,
        host::formatted("no_surface %zu lies wholly beyond where a search is aborted: nothing ever surfaces there, and no search passes it",
                        i + 1));
  }
}

void check_key(const host::MissionFile& file, Warnings& warnings) {
  warn_if(!file.command_key, warnings, "there is no authority.key_file: anybody on the bus may command the vehicle");
  const std::string name = host::vehicle_id_of(file.challenge);
  warn_if(!file.command_key && !name.empty(), warnings,
          "vehicle_id, \"" + host::printable(name) + "\", has no effect on orders without authority.key_file");
  if (!file.command_key) return;
  warn_if(file.command_key->is_all_zero(), warnings, "the key in authority.key_file is all zeros, which anybody guesses");
  warn_if(file.accepts_old_marks, warnings,
          "accept_old_marks is true: an order that was recorded is obeyed again after a restart, and by every other vehicle with this key");
}

void check_ports(const host::MissionFile& file, Warnings& warnings) {
  const bool is_deafness_reported = std::ranges::any_of(file.ports, [&file](const host::PortSettings& port) {
    return port.roles.has(host::Role::kSnr) || (file.hearing && port.roles.has(host::Role::kHydrophone));
  });
  warn_if(!is_deafness_reported && has_rule_about(file.mission, config::Condition::kHydrophoneDeaf), warnings,
          "no port has the role \"snr\", and no hydrophone is listened to: nobody can report that the hydrophone is deaf, and the rule "
          "about it "
          "(hydrophone_deaf) never acts");
  for (const host::PortSettings& port : file.ports) {
    std::error_code error;
    const bool is_missing = port.kind == host::PortKind::kCan && !std::filesystem::exists("/sys/class/net/" + port.address, error);
    warn_if(is_missing, warnings, "this computer has no interface " + host::printable(port.address) + " now");
  }
}

/// Values that no hydrophone, amplifier or ADC of today has: of another unit, or of a typing error.
void check_devices(const detector::Calibration& chain, Warnings& warnings) {
  struct Usual {
    const char* key;
    double value;
    double least;
    double most;
    const char* whose;
  };
  const std::array<Usual, 4> usual{{{"sensitivity_db_re_1v_per_upa", chain.sensitivity.value, -225.0, -120.0, "hydrophones"},
                                    {"gain_db", chain.fixed_gain.value, -40.0, 120.0, "amplifiers"},
                                    {"full_scale_v", chain.full_scale_volts, 0.01, 30.0, "ADCs"},
                                    {"adc_bits", static_cast<double>(chain.adc_bits), 12.0, 32.0, "ADCs for sound"}}};
  for (const Usual& u : usual)
    warn_if(u.value < u.least || u.value > u.most, warnings,
            host::formatted("hydrophone.%s, %g: %s have %g to %g", u.key, u.value, u.whose, u.least, u.most));
}

/// By spherical spreading a source is so much louder at a tenth of the range at which it just reaches the threshold.
constexpr Decibels kRoomForLoud{20.0};
/// A recorder's own noise should lie 6 dB under the lowest that is to be measured (NPL Good Practice Guide 133), and the sea is at times
/// 10 dB quieter than is expected.
constexpr Decibels kRoomForQuiet{16.0};

void check_chain(const detector::SoundSettings& hearing, Warnings& warnings) {
  check_devices(hearing.calibration, warnings);
  if (!is_finite(hearing.expected_noise.value)) {
    warnings.emplace_back(
        "hydrophone.expected_noise_db_re_1upa is left out: whether the chain is too loud or too faint for the sea cannot be judged before "
        "the dive");
    return;
  }
  const host::ChainRoom room = host::room_of(hearing);
  warn_if(room.full_scale < room.least_full_scale + kRoomForLoud, warnings,
          host::formatted(
              "the hydrophone's chain clips at %.1f dB re 1 uPa, %.1f dB above hydrophone.expected_noise_db_re_1upa: a source that is "
              "near gives no SNR measurement, with less gain_db it would",
              room.full_scale.value, (room.full_scale - hearing.expected_noise).value));
  const Decibels most = hearing.expected_noise - kRoomForQuiet;
  warn_if(room.adc_noise_at_lowest_rate > most, warnings,
          host::formatted(
              "the ADC's own noise in the hydrophone's band is %.1f dB re 1 uPa where blocks come at %g Hz, and %.1f at %g Hz: more "
              "than %g, %g dB under hydrophone.expected_noise_db_re_1upa, hides a quiet sea; more gain_db or adc_bits make it less",
              room.adc_noise_at_lowest_rate.value, room.lowest_rate.value, room.adc_noise_at_highest_rate.value,
              messages::kHighestSampleRate.value, most.value, kRoomForQuiet.value));
}

/// What can be heard, but not well: a mission file in which nothing could be heard has been refused.
void check_hearing(const host::MissionFile& file, Warnings& warnings) {
  if (!file.hearing) return;
  const detector::SoundSettings& hearing = *file.hearing;
  const double frequency_hz = file.mission.source_frequency.value;
  // The ocean tables count for sources that lie so far from the mission's frequency.
  const double farthest_hz = policy::kFrequencyTolerance * frequency_hz;
  warn_if(frequency_hz - farthest_hz < hearing.band.low.value || frequency_hz + farthest_hz > hearing.band.high.value, warnings,
          host::formatted(
              "search.source_frequency_hz, %g Hz, lies within %g %% of an end of the hydrophone's band, %g to %g Hz: at the end half of a "
              "sound is lost, and beyond it all",
              frequency_hz, 100.0 * policy::kFrequencyTolerance, hearing.band.low.value, hearing.band.high.value));
  const config::ListeningWindow& window = file.mission.listening;
  const bool needs_pauses = hearing.noise_reference == detector::NoiseReference::kPast;
  warn_if(
      needs_pauses && window.listening == config::Listening::kNewest, warnings,
      "search.listening is \"newest\", and hydrophone.preset is one of calls: a decision that falls into a pause between two calls hears "
      "nothing");
  warn_if(
      window.listening != config::Listening::kNewest && window.length < hearing.integration_time, warnings,
      host::formatted(
          "search.listening_window_s, %g s, is shorter than hydrophone.integration_time_s, %g s: its SNR measurements are all of one sound",
          window.length.to_seconds(), hearing.integration_time.to_seconds()));
  const double leg_s = file.mission.step_length.value / file.mission.search_speed.value;
  warn_if(leg_s < hearing.integration_time.to_seconds(), warnings,
          host::formatted(
              "hydrophone.integration_time_s, %g s, is longer than a step of %g m at %g m/s, %.1f s: a decision hears the leg before, too",
              hearing.integration_time.to_seconds(), file.mission.step_length.value, file.mission.search_speed.value, leg_s));
  const double gate_mps = hearing.gate.speed.value;
  const double current_mps = file.mission.safety.vehicle.max_current.value;
  warn_if(gate_mps < file.mission.search_speed.value + current_mps, warnings,
          host::formatted(
              "hydrophone.self_noise_speed_mps, %g m/s, is less than search.speed_mps and vehicle.max_current_mps together: the vehicle "
              "knows its speed over ground, and measures nothing where a current pushes it",
              gate_mps));
  check_chain(hearing, warnings);
}

}  // namespace

std::vector<std::string> mission_warnings(const host::MissionFile& file) {
  Warnings warnings;
  check_limits(file.mission, warnings);
  check_vehicle(file.mission.safety.vehicle, warnings);
  check_steps(file.mission, warnings);
  check_time(file.mission, warnings);
  check_battery(file.mission, warnings);
  check_zones(file.mission, warnings);
  std::ranges::move(rule_warnings(file.mission), std::back_inserter(warnings));
  check_key(file, warnings);
  check_ports(file, warnings);
  check_hearing(file, warnings);
  return warnings;
}

}  // namespace earshot::board
