#include "firmware/boards/linux/outage/lost_record.hpp"

#include <variant>

#include "firmware/boards/linux/outage/safety_log.hpp"
#include "firmware/core/overloads.hpp"
#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/journal/journal_name.hpp"
#include "firmware/host/journal/reading/record_source.hpp"
#include "firmware/wire/lcm/channels.hpp"

namespace earshot::board {
namespace {

struct Standing {
  config::Mission mission;
  runtime::Outputs outputs;
  Time time;
  bool is_ended = false;  ///< in order
};

void note(const journal::Record& record, Standing& standing) {
  standing.time = record.time;
  standing.is_ended = record.channel == wire::kJournalEndChannel;  // of another version of Earshot, too
  std::visit(Overloads{[&](const messages::MissionRecord& begun) { standing.mission = begun.mission; },
                       [&](const messages::Setpoint& setpoint) { standing.outputs.setpoint = setpoint; },
                       [&](const messages::Health& health) {
                         standing.outputs.health.state = health.state;
                         standing.outputs.health.end_reason = health.end_reason;
                         standing.outputs.health.is_paused = health.is_paused;
                       },
                       Unheeded<journal::Unreadable, journal::PolicyBytes, journal::TablesBytes, messages::Input, messages::Decision,
                                messages::SafetyEvent, messages::CommandAcknowledgement, messages::ClosingRecord, messages::JournalResumed,
                                messages::ControllerTrouble, messages::SoundDetection, messages::PublishedChallenge>{}},
             record.content);
}

}  // namespace

std::optional<host::SafetyRecord> record_by_journal(const std::filesystem::path& wanted) {
  Standing standing;
  try {
    const std::optional<std::filesystem::path> newest = host::newest_journal(wanted);
    if (!newest) return std::nullopt;
    journal::for_each_record(*newest, [&standing](const journal::Record& record) { note(record, standing); });
  } catch (const host::BadInput&) {
    return std::nullopt;
  }
  host::SafetyRecord record;
  record.mission_time = standing.time;
  (void)put_standing(standing.outputs, standing.mission, record);
  return !standing.is_ended && host::is_under_way(record) ? std::optional(record) : std::nullopt;
}

}  // namespace earshot::board
