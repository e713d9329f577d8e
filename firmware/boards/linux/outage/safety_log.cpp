#include "firmware/boards/linux/outage/safety_log.hpp"

#include <algorithm>

#include "firmware/core/crc32.hpp"

namespace earshot::board {

bool put_standing(const runtime::Outputs& outputs, const config::Mission& mission, host::SafetyRecord& record) {
  host::SafetyRecord now = record;
  now.state = outputs.health.state;
  now.end_reason = outputs.health.end_reason;
  now.is_paused = outputs.health.is_paused;
  // Once the vehicle is commanded it stays so, and what was released does not come back.
  now.is_engaged = record.is_engaged || outputs.setpoint.has_value();
  now.is_released = record.is_released || (outputs.setpoint && outputs.setpoint->release_weight);
  now.max_depth = mission.max_depth;
  now.max_speed = mission.search_speed;
  now.max_time = mission.max_time;
  now.deepest = std::max(record.deepest, mission.max_depth);
  now.ascent_speed = mission.safety.vehicle.ascent_speed;
  now.turn_radius = mission.safety.vehicle.turn_radius;
  const bool has_changed = !(now == record);
  record = now;
  record.turn = outputs.health.turn;
  return has_changed;
}

bool SafetyLog::begin(Time now, const config::Mission& mission, std::uint32_t journal_crc32, std::span<const std::uint8_t> kept,
                      std::chrono::milliseconds patience) {
  record_ = {};
  record_.mission_time = now;
  record_.journal_crc32 = journal_crc32;
  record_.kept_crc32 = crc32(kept);
  (void)put_standing({}, mission, record_);
  depth_ = {};
  copies_.prepare(kept);
  date();
  return copies_.write(record_, patience);
}

bool SafetyLog::note(Time turn, const runtime::Outputs& outputs, const config::Mission& mission, std::chrono::milliseconds patience) {
  const bool has_changed = put_standing(outputs, mission, record_);
  vehicle_ = mission.safety.vehicle;
  if (outputs.setpoint) depth_.note_order(turn, *outputs.setpoint, vehicle_);
  const Duration running = host_.since_boot();
  const Duration since = running - record_.since_boot;
  const bool is_stamp_due = record_.state != messages::MissionState::kStandby && since >= kBetweenStamps;
  if (!has_changed && !is_stamp_due) return copies_.is_durable();
  record_.mission_time = turn;
  if (running - began_ >= kFlownForAWhile) record_.starts = 0;
  date();
  if (has_changed || since >= kHangs) return copies_.write(record_, patience);
  copies_.stamp(record_);
  return copies_.is_durable();
}

bool SafetyLog::abort(std::chrono::milliseconds patience) {
  record_.state = messages::MissionState::kAbort;
  record_.end_reason = messages::EndReason::kOperatorAbort;
  date();
  return copies_.write(record_, patience);
}

bool SafetyLog::release(std::chrono::milliseconds patience) {
  record_.is_released = true;
  date();
  return copies_.write(record_, patience);
}

void SafetyLog::stamp(Time now) {
  if (host_.since_boot() - record_.since_boot < kBetweenStamps) return;
  record_.mission_time = now;
  date();
  copies_.stamp(record_);
}

bool SafetyLog::close(std::chrono::milliseconds patience, bool is_up) {
  record_.is_closed = !record_.is_engaged || is_up || depth_.is_up(vehicle_);
  date();
  return copies_.write(record_, patience) && record_.is_closed;
}

/// Of a flight that goes on: a depth that is told now may be wrong, and the vehicle as deep as it ever may have been.
void SafetyLog::start_from(Meters deepest) {
  messages::Navigation fix;
  fix.depth = deepest;
  depth_.take(fix);
  messages::Setpoint ordered;
  ordered.depth = deepest;
  depth_.note_order(record_.mission_time, ordered, vehicle_);
}

void SafetyLog::date() {
  record_.boot = boot_;
  record_.since_boot = host_.since_boot();
  record_.utc = host_.utc();
}

}  // namespace earshot::board
