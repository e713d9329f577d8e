#include "firmware/host/journal/words/sentences.hpp"

#include <cmath>
#include <numbers>
#include <string_view>

#include "firmware/core/geometry.hpp"
#include "firmware/host/file/printable.hpp"
#include "firmware/host/journal/words/wording.hpp"
#include "firmware/host/text/numbers.hpp"
#include "firmware/messages/dictionary/command_words.hpp"
#include "firmware/messages/dictionary/health_words.hpp"
#include "firmware/messages/dictionary/journal_fields.hpp"

namespace earshot::journal {
namespace {

using messages::EndReason;
using messages::MissionState;

std::string command_name(messages::Order order, std::uint32_t number, std::uint32_t issuer) {
  return std::string("order ") + messages::to_string(order) + ", number " + std::to_string(number) + " of issuer " + std::to_string(issuer);
}

std::string limits_in(const messages::OperatorLimits& limits) {
  std::string text;
  const auto add_limit = [&text](const std::string& limit) { text += (text.empty() ? " to " : ", ") + limit; };
  if (limits.max_depth) add_limit(host::decimals(limits.max_depth->value, 1) + " m depth");
  if (limits.max_speed) add_limit(host::decimals(limits.max_speed->value, 2) + " m/s");
  if (limits.max_time_s) add_limit(host::decimals(*limits.max_time_s, 0) + " s of search");
  return text;
}

std::string bytes_to_string(const DamagedBytes& damage) {
  return host::counted(damage.bytes, "byte") + " from byte " + std::to_string(damage.offset) + " on" +
         (damage.part.empty() ? "" : " of " + damage.part);
}

/// "software 0.2.0, commit 5442074c"; what another program calls itself stays in one piece.
std::string build_to_string(std::string_view build) {
  const std::size_t space = build.find(' ');
  const std::string version(build.substr(0, space));
  const std::string commit(space == std::string_view::npos ? "" : build.substr(space + 1));
  return "software " + host::printable(version) + (commit.empty() ? "" : ", commit " + host::printable(commit));
}

}  // namespace

std::string to_string(const messages::MissionRecord& record) {
  constexpr double kMetersPerKilometer = 1000.0;
  const config::Mission& m = record.mission;
  const NorthEast size = m.operating_area.north_east - m.operating_area.south_west;
  return "mission begins: area of " + host::decimals(size.north.value / kMetersPerKilometer, 1) + " km x " +
         host::decimals(size.east.value / kMetersPerKilometer, 1) + " km, at " + host::decimals(m.search_depth.value, 0) + " m depth and " +
         host::decimals(m.search_speed.value, 1) + " m/s, up to " + host::counted(m.max_steps, "step") + " of " +
         host::decimals(m.step_length.value, 0) + " m in " + host::decimals(m.max_time.to_seconds(), 0) + " s; detection threshold " +
         host::decimals(m.detection_threshold.value, 1) + " dB; " + build_to_string(messages::text_of(record.build));
}

std::string to_string(const messages::OperatorCommand& command, std::uint8_t port) {
  // Port 0 is the program's own.
  const std::string by = port == 0 ? ", by the program, which is being stopped" : ", by port " + std::to_string(port);
  return command_name(command.order, command.number, command.issuer) + limits_in(command.limits) + by;
}

std::string to_string(const messages::CommandAcknowledgement& m) {
  return command_name(m.order, m.number, m.issuer) + ": " + messages::to_string(m.outcome);
}

std::string to_string(const messages::Bearing& bearing) {
  std::string text = compass(bearing.direction, 0) + " deg";
  if (bearing.mirror_axis) {
    const Radians mirrored = 2.0 * *bearing.mirror_axis - bearing.direction;
    text += " or " + compass(mirrored, 0) + " deg";
  }
  constexpr double kDegreesPerRadian = 180.0 / std::numbers::pi;
  return text + ", give or take " + host::decimals(bearing.deviation.value * kDegreesPerRadian, 0) + " deg";
}

std::string to_string(const messages::Decision& m) {
  const NorthEast leg = m.waypoint - m.position;
  std::string bearing = compass(bearing_of(leg.north.value, leg.east.value), 0);
  bearing.insert(0, bearing.size() < 3 ? 3 - bearing.size() : 0, '0');
  std::string text = "step " + std::to_string(m.step) + ": SNR " + (m.too_faint ? "below " : "") + host::decimals(m.snr.value, 1) + " dB" +
                     (m.detected ? ", detection" : ", no detection") + (m.bearing ? ", from " + to_string(*m.bearing) : "") + "; from " +
                     to_string(m.position) + " goes " + host::decimals(length_of(leg).value, 0) + " m towards " + bearing + " deg";
  if (m.sweeping) text += ", of a sweep";
  if (m.overridden) text += ", as the safety layer changed it";
  if (m.belief)
    text += "; the source is likeliest at " + to_string(m.belief->likeliest) + ", the belief spread over " +
            host::decimals(m.belief->spread.value, 0) + " m";
  if (m.found)
    text += "; declares the source found: within a step with a probability of " + host::decimals(m.found->probability, 2) + ", at least " +
            host::decimals(m.found->least_snr.value, 1) + " dB expected there, the likeliest place " +
            host::decimals(m.found->closest_approach.value, 0) + " m away";
  return text;
}

std::string to_string(MissionState state, EndReason reason, std::uint32_t steps, AbortedBy by) {
  host::TextLine line;
  write_standing(line, state, reason, steps, by);
  return std::string(line.text());
}

std::string to_string(const messages::Health& m, bool was_mismatched, AbortedBy by) {
  host::TextLine line;
  write_state(line, m, messages::remark_on(m, was_mismatched), by);
  return std::string(line.text());
}

std::string to_string(const messages::LostRecords& lost) {
  return std::to_string(lost.streams) + " of navigation, SNR and health, " + std::to_string(lost.steering) + " set-points and decisions, " +
         std::to_string(lost.orders) + " orders and changes of state";
}

std::string to_string(const messages::ClosingRecord& closing, AbortedBy by) {
  const messages::LostRecords& lost = closing.lost;
  const std::string what =
      lost.all() == 0 ? "no record was lost" : host::counted(lost.all(), "record") + " lost on a full or slow disk: " + to_string(lost);
  return std::string("end: ") + messages::to_string(closing.ending) + "; " +
         to_string(closing.state, closing.end_reason, closing.steps_taken, by) + "; " + what;
}

std::string to_string(const messages::JournalResumed& resumed) {
  return "another process goes on from here (earshotd --resume): the one before was killed or lost its power; " +
         host::counted(resumed.cut_bytes, "byte") + " that it left behind were cut off";
}

std::string to_string(const messages::ControllerTrouble& trouble) {
  return "port " + std::to_string(trouble.port) + ": " + std::string(words_of(trouble.trouble, trouble.is_there));
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
  return host::counted(missing.count, "record") + (missing.count == 1 ? " is" : " are") + " missing, " + which + why_missing(missing);
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

}  // namespace earshot::journal
