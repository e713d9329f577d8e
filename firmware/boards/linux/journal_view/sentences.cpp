#include "firmware/boards/linux/journal_view/sentences.hpp"

#include <cmath>
#include <cstring>
#include <iterator>
#include <numbers>
#include <optional>

#include "firmware/boards/linux/journal_view/wording.hpp"
#include "firmware/core/geometry.hpp"
#include "firmware/host/file/printable.hpp"
#include "firmware/messages/command_words.hpp"
#include "firmware/messages/health_words.hpp"
#include "firmware/wire/lcm/conversion.hpp"

namespace earshot::journal_view {
namespace {

using messages::Authority;
using messages::EndReason;
using messages::MissionState;

std::string command_name(std::int8_t order, std::uint32_t number, std::uint32_t issuer) {
  return std::string("order ") + messages::to_string(static_cast<messages::Order>(order)) + ", number " + std::to_string(number) +
         " of issuer " + std::to_string(issuer);
}

std::string limits_in(const messages::OperatorLimits& limits) {
  std::string text;
  const auto say = [&text](const std::string& limit) { text += (text.empty() ? " to " : ", ") + limit; };
  if (limits.max_depth) say(decimal(limits.max_depth->value, 1) + " m depth");
  if (limits.max_speed) say(decimal(limits.max_speed->value, 2) + " m/s");
  if (limits.max_time_s) say(decimal(*limits.max_time_s, 0) + " s of search");
  return text;
}

std::string build_of(const mission_t& mission) {
  const char* const build = reinterpret_cast<const char*>(mission.build);
  return host::printable({build, ::strnlen(build, std::size(mission.build))});
}

std::string state_to_string(MissionState state, EndReason reason, std::int64_t steps, AbortedBy by) {
  const bool is_stopped = reason == EndReason::kOperatorAbort && by == AbortedBy::kProgram;
  const std::string why = is_stopped ? "its program was stopped" : messages::to_string(reason);
  const std::string ended = reason == EndReason::kNone ? "" : ": " + why;
  if (!messages::counts_steps(reason)) return messages::to_string(state) + ended;
  return messages::to_string(state) + ended + ", after " + counted(static_cast<std::uint64_t>(steps < 0 ? 0 : steps), "step");
}

std::string bytes_to_string(const DamagedBytes& damage) {
  return counted(damage.bytes, "byte") + " from byte " + std::to_string(damage.offset) + " on" +
         (damage.part.empty() ? "" : " of " + damage.part);
}

const char* to_string(wire::Ending ending) {
  switch (ending) {
    case wire::Ending::kMissionOver:
      return "the mission was over";
    case wire::Ending::kStopped:
      return "the program was stopped";
    case wire::Ending::kClockLost:
      return "the simulator was gone";
  }
  return "?";
}

}  // namespace

std::string to_string(const mission_t& m) {
  constexpr double kMetersPerKilometer = 1000.0;
  const double seconds = static_cast<double>(m.max_time_us) / 1e6;
  return "mission begins: area of " + decimal((m.north_m - m.south_m) / kMetersPerKilometer, 1) + " km x " +
         decimal((m.east_m - m.west_m) / kMetersPerKilometer, 1) + " km, at " + decimal(m.search_depth_m, 0) + " m depth and " +
         decimal(m.search_speed_mps, 1) + " m/s, up to " + counted(static_cast<std::uint32_t>(m.max_steps), "step") + " of " +
         decimal(m.step_length_m, 0) + " m in " + decimal(seconds, 0) + " s; heard from " + decimal(m.detection_threshold_db, 1) +
         " dB; flown by " + build_of(m);
}

std::string to_string(const messages::OperatorCommand& command, std::uint8_t port) {
  // Port 0 is the program's own.
  const std::string by = port == 0 ? ", by the program, which is being stopped" : ", by port " + std::to_string(port);
  return command_name(static_cast<std::int8_t>(command.order), command.number, command.issuer) + limits_in(command.limits) + by;
}

std::string to_string(const command_acknowledgement_t& m) {
  return command_name(m.command, static_cast<std::uint32_t>(m.number), static_cast<std::uint32_t>(m.issuer)) + ": " +
         messages::to_string(static_cast<messages::CommandOutcome>(m.outcome));
}

std::string to_string(const messages::Bearing& bearing) {
  std::string text = compass(bearing.direction, 0) + " deg";
  if (bearing.mirror_axis) {
    const Radians mirrored = 2.0 * *bearing.mirror_axis - bearing.direction;
    text += " or " + compass(mirrored, 0) + " deg";
  }
  constexpr double kDegreesPerRadian = 180.0 / std::numbers::pi;
  return text + ", give or take " + decimal(bearing.deviation.value * kDegreesPerRadian, 0) + " deg";
}

std::string to_string(const decision_t& m) {
  const NorthEast place{Meters{m.north_m}, Meters{m.east_m}};
  const NorthEast waypoint{Meters{m.waypoint_north_m}, Meters{m.waypoint_east_m}};
  const NorthEast leg = waypoint - place;
  std::string bearing = compass(bearing_of(leg.north.value, leg.east.value), 0);
  bearing.insert(0, bearing.size() < 3 ? 3 - bearing.size() : 0, '0');
  const std::optional<messages::Bearing> source = wire::bearing_in(m);
  std::string text = "step " + std::to_string(m.step) + ": SNR " + (m.too_faint != 0 ? "below " : "") + decimal(m.snr_db, 1) + " dB" +
                     (m.detected != 0 ? ", heard" : ", not heard") + (source ? ", from " + to_string(*source) : "") + "; from " +
                     to_string(place) + " goes " + decimal(length_of(leg).value, 0) + " m towards " + bearing + " deg";
  if (m.sweeping != 0) text += ", of a sweep";
  if (m.overridden != 0) text += ", as the safety layer changed it";
  if (m.believes != 0)
    text += "; the source is likeliest at " + to_string({Meters{m.likeliest_north_m}, Meters{m.likeliest_east_m}}) +
            ", the belief spread over " + decimal(m.spread_m, 0) + " m";
  if (m.found != 0)
    text += "; declares the source found: within a step with a probability of " + decimal(m.found_probability, 2) + ", at least " +
            decimal(m.found_least_snr_db, 1) + " dB expected there, the likeliest place " + decimal(m.closest_approach_m, 0) + " m away";
  return text;
}

std::string to_string(const health_t& m, bool was_surprised, AbortedBy by) {
  const auto reason = static_cast<EndReason>(m.end_reason);
  const auto authority = static_cast<Authority>(m.authority);
  const auto state = static_cast<MissionState>(m.state);
  if (reason != EndReason::kNone) return state_to_string(state, reason, m.steps_taken, by);
  std::string text = messages::to_string(state);
  if (authority == Authority::kDisconnected) return text + ", the autopilot is not heard";
  if (authority == Authority::kListen) return text + ", listening: it commands nothing";
  if (m.paused != 0) return text + ", paused by an operator";
  if (m.found != 0) return text + ", " + std::string(messages::kSaysFound);
  return m.sweeping != 0 ? text + ", " + std::string(was_surprised ? messages::kSweeps : messages::kSweepsInSilence) : text;
}

std::string to_string(const wire::ClosingRecord& closing, AbortedBy by) {
  const wire::ClosingRecord::Lost& lost = closing.lost;
  const std::string what = lost.all() == 0
                               ? "no record was lost"
                               : counted(lost.all(), "record") + " lost on a full or slow disk: " + std::to_string(lost.streams) +
                                     " of navigation, SNR and health, " + std::to_string(lost.steering) + " set-points and decisions, " +
                                     std::to_string(lost.orders) + " orders and changes of state";
  return std::string("end: ") + to_string(closing.ending) + "; " +
         state_to_string(closing.state, closing.end_reason, closing.steps_taken, by) + "; " + what;
}

std::string to_string(const journal_resumed_t& resumed) {
  return "another process goes on from here (earshotd --resume): the one before was killed or lost its power; " +
         counted(static_cast<std::uint64_t>(resumed.cut_bytes), "byte") + " that it left behind were cut off";
}

std::string to_string(const controller_trouble_t& trouble) {
  const bool is_bus_off = trouble.trouble == controller_trouble_t::BUS_OFF;
  const char* const begins = is_bus_off ? "has left the bus after too many errors (bus-off)" : "counts many errors (error-passive)";
  const char* const ends = is_bus_off ? "is back on the bus" : "counts few errors";
  return "port " + std::to_string(trouble.port) + ": the CAN controller " + (trouble.is_there != 0 ? begins : ends);
}

namespace {

std::string why_missing(const MissingRecords& missing) {
  if (missing.parts == 1) return ": part " + std::to_string(missing.first_part) + " of the journal is not there";
  if (missing.parts > 1)
    return ": parts " + std::to_string(missing.first_part) + " to " + std::to_string(missing.first_part + missing.parts - 1) +
           " of the journal are not there";
  return missing.was_damaged ? ", where the file is damaged" : ": the disk was full or too slow";
}

}  // namespace

std::string to_string(const MissingRecords& missing) {
  const std::string which = missing.count == 1
                                ? "number " + std::to_string(missing.first)
                                : "numbers " + std::to_string(missing.first) + " to " + std::to_string(missing.first + missing.count - 1);
  return counted(missing.count, "record") + (missing.count == 1 ? " is" : " are") + " missing, " + which + why_missing(missing);
}

std::string to_string(const DamagedBytes& damage) {
  return "damaged: " + bytes_to_string(damage) + " are no record, or do not match their checksum";
}

std::string to_string(const TornEnd& end) {
  if (!end.is_cut) return "the end is damaged: " + bytes_to_string(end.where) + " are no record";
  return "the journal ends in the middle of a record (" + bytes_to_string(end.where) + "): its program was stopped while it wrote";
}

std::string to_string(const NumbersGoBack& numbers) {
  return "the records' numbers go back from " + std::to_string(numbers.from) + " to " + std::to_string(numbers.to) +
         ": what follows was not written behind it";
}

}  // namespace earshot::journal_view
