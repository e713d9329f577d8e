#include "firmware/boards/linux/outage/lost_record.hpp"

#include "earshot/health_t.hpp"
#include "earshot/mission_t.hpp"
#include "earshot/setpoint_t.hpp"
#include "firmware/boards/linux/outage/safety_log.hpp"
#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/journal/journal_name.hpp"
#include "firmware/host/journal/journal_reader.hpp"
#include "firmware/wire/lcm/channels.hpp"
#include "firmware/wire/lcm/conversion.hpp"
#include "firmware/wire/lcm/encoding.hpp"

namespace earshot::board {
namespace {

struct Standing {
  config::Mission mission;
  runtime::Outputs outputs;
  Time time;
  bool is_ended = false;  ///< in order
};

void note(const host::JournalRecord& record, Standing& standing) {
  standing.time = record.time;
  standing.is_ended = record.channel == wire::kJournalEndChannel;
  mission_t mission{};
  health_t health{};
  setpoint_t setpoint{};
  if (record.channel == wire::kMissionChannel && wire::decode(record.data, mission) == Status::kOk) {
    standing.mission = wire::from_message(mission);
  } else if (record.channel == wire::kJournalledSetpointChannel && wire::decode(record.data, setpoint) == Status::kOk) {
    standing.outputs.setpoint = wire::from_message(setpoint);
  } else if (record.channel == wire::kHealthChannel && wire::decode(record.data, health) == Status::kOk) {
    standing.outputs.health.state = static_cast<messages::MissionState>(health.state);
    standing.outputs.health.end_reason = static_cast<messages::EndReason>(health.end_reason);
    standing.outputs.health.is_paused = health.paused != 0;
  }
}

}  // namespace

std::optional<host::SafetyRecord> record_by_journal(const std::filesystem::path& wanted) {
  Standing standing;
  try {
    const std::optional<std::filesystem::path> newest = host::newest_journal(wanted);
    if (!newest) return std::nullopt;
    host::JournalReader reader(*newest);
    for (host::JournalRecord record; reader.next(record);) note(record, standing);
  } catch (const host::BadInput&) {
    return std::nullopt;
  }
  host::SafetyRecord record;
  record.mission_time = standing.time;
  (void)put_standing(standing.outputs, standing.mission, record);
  return !standing.is_ended && host::is_under_way(record) ? std::optional(record) : std::nullopt;
}

}  // namespace earshot::board
