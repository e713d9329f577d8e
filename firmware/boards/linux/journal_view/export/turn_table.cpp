#include "firmware/boards/linux/journal_view/export/turn_table.hpp"

#include <string_view>

#include "firmware/boards/linux/journal_view/wording.hpp"
#include "firmware/core/math.hpp"
#include "firmware/messages/dictionary/mission_words.hpp"
#include "firmware/messages/dictionary/safety_words.hpp"

namespace earshot::journal_view {
namespace {

constexpr std::string_view kHeader =
    "turn,time_s,mission_s,utc,state,steps_taken,response,navigation_age_s,north_m,east_m,latitude_deg,longitude_deg,depth_m,heading_deg,"
    "speed_mps,snr_age_s,snr_db,snr_too_faint,setpoint_heading_deg,setpoint_speed_mps,setpoint_depth_m,waypoint_north_m,waypoint_east_m,"
    "altitude_m,battery_percent,surprise_bits,sweeping,found\n";

/// A row in the making.
class Row {
 public:
  Row& cell(std::string_view text) {
    text_ += text_.empty() ? "" : ",";
    text_ += text;
    return *this;
  }
  /// What is no number is empty.
  Row& cell(double number, int places) { return cell(is_finite(number) ? decimal(number, places) : std::string()); }
  Row& empty(int cells) {
    for (; cells > 0; --cells) cell("");
    return *this;
  }
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  std::string text_;
};

constexpr int kMillimeters = 3;
constexpr int kMillidegrees = 3;
constexpr int kMicroseconds = 6;
constexpr int kCentimetersOfArc = 7;  // of a degree of latitude
constexpr int kHundredths = 2;

void put_fix(Row& row, Time now, const messages::Navigation& fix, const std::optional<n2k::LocalPlane>& plane) {
  row.cell((now - fix.time).to_seconds(), kMicroseconds)
      .cell(fix.position.north.value, kMillimeters)
      .cell(fix.position.east.value, kMillimeters);
  const auto place = plane ? plane->to_geographic(fix.position) : Result<n2k::Geographic>(Status::kOutOfRange);
  if (place.ok())
    row.cell(place.value().latitude_deg, kCentimetersOfArc).cell(place.value().longitude_deg, kCentimetersOfArc);
  else
    row.empty(2);
  row.cell(fix.depth.value, kMillimeters).cell(compass(fix.heading, kMillidegrees)).cell(fix.speed.value, kMillimeters);
}

void put_setpoint(Row& row, const messages::Setpoint& setpoint) {
  row.cell(compass(setpoint.heading, kMillidegrees))
      .cell(setpoint.speed.value, kMillimeters)
      .cell(setpoint.depth.value, kMillimeters)
      .cell(setpoint.waypoint.north.value, kMillimeters)
      .cell(setpoint.waypoint.east.value, kMillimeters);
}

}  // namespace

TurnTable::TurnTable(const std::filesystem::path& path, const std::optional<n2k::LocalPlane>& plane) : file_(path), plane_(plane) {
  file_.write(kHeader);
}

void TurnTable::take(const Entry& entry, std::span<const Event> /*events*/) {
  const auto* const record = std::get_if<Record>(&entry);
  if (record == nullptr) return;
  if (!began_) began_ = record->time;
  if (const auto* const input = std::get_if<messages::Input>(&record->content)) note(*input);
  if (const auto* const setpoint = std::get_if<messages::Setpoint>(&record->content)) setpoint_ = *setpoint;
  if (const auto* const health = std::get_if<health_t>(&record->content)) write_row(record->time, *health);
}

void TurnTable::note(const messages::Input& input) {
  if (const auto* const fix = std::get_if<messages::Navigation>(&input.value); fix != nullptr && messages::is_usable(*fix)) fix_ = *fix;
  if (const auto* const snr = std::get_if<messages::SnrMeasurement>(&input.value); snr != nullptr && messages::is_possible_snr(snr->snr))
    snr_ = *snr;
  if (const auto* const status = std::get_if<messages::VehicleStatus>(&input.value)) status_ = *status;
}

void TurnTable::write_row(Time time, const health_t& health) {
  Row row;
  row.cell(std::to_string(health.turn))
      .cell(decimal(seconds_of(time), kMicroseconds))
      .cell((time - *began_).to_seconds(), kMicroseconds)
      .cell(is_dated(time) ? utc(time) : "")
      .cell(messages::to_string(static_cast<messages::MissionState>(health.state)))
      .cell(std::to_string(health.steps_taken));
  const bool is_response = messages::is_value_of<config::Response>(health.response);
  row.cell(is_response ? messages::key_of(static_cast<config::Response>(health.response)) : std::string_view());
  if (fix_)
    put_fix(row, time, *fix_, plane_);
  else
    row.empty(8);
  if (snr_)
    row.cell((time - snr_->time).to_seconds(), kMicroseconds).cell(snr_->snr.value, kHundredths).cell(snr_->too_faint ? "1" : "0");
  else
    row.empty(3);
  if (setpoint_)
    put_setpoint(row, *setpoint_);
  else
    row.empty(5);
  row.cell(status_.altitude.value, kHundredths).cell(status_.battery_percent, kHundredths);
  row.cell(health.surprise_bits, kHundredths).cell(health.sweeping != 0 ? "1" : "0").cell(health.found != 0 ? "1" : "0");
  file_.write(row.text() + "\n");
  setpoint_.reset();
  ++rows_;
}

std::string TurnTable::what() const {
  return counted(rows_, "turn");
}

}  // namespace earshot::journal_view
