#include "firmware/desk/journal_view/export/turn_table.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>

#include "firmware/core/math.hpp"
#include "firmware/host/journal/words/wording.hpp"
#include "firmware/host/text/numbers.hpp"
#include "firmware/host/text/utc.hpp"
#include "firmware/messages/dictionary/output_fields.hpp"

namespace earshot::journal {
namespace {

using std::literals::operator""sv;

constexpr std::string_view kHeader =
    "turn,time_s,mission_s,utc,state,steps_taken,response,navigation_age_s,north_m,east_m,latitude_deg,longitude_deg,depth_m,heading_deg,"
    "speed_mps,snr_age_s,snr_db,snr_too_faint,setpoint_heading_deg,setpoint_speed_mps,setpoint_depth_m,waypoint_north_m,waypoint_east_m,"
    "altitude_m,battery_percent,surprise_bits,sweeping,found";

/// The fields of a message that have columns above, by their names in its list. Whatever else it tells has a column behind them.
template <class Message>
constexpr std::array<std::string_view, 0> kAbove{};
template <>
constexpr std::array kAbove<messages::Navigation>{"utime"sv, "north_m"sv, "east_m"sv, "depth_m"sv, "heading_rad"sv, "speed_mps"sv};
template <>
constexpr std::array kAbove<messages::SnrMeasurement>{"utime"sv, "snr_db"sv, "too_faint"sv};
template <>
constexpr std::array kAbove<messages::Setpoint>{"heading_rad"sv, "speed_mps"sv, "depth_m"sv, "waypoint_north_m"sv, "waypoint_east_m"sv};
template <>
constexpr std::array kAbove<messages::VehicleStatus>{"utime"sv, "altitude_m"sv, "battery_percent"sv};
template <>
constexpr std::array kAbove<messages::Health>{"turn"sv,          "state"sv,    "steps_taken"sv, "response"sv,
                                              "surprise_bits"sv, "sweeping"sv, "found"sv};

/// Calls `take(line)` with the fields that have none, of those that are one value.
template <class Message, class Take>
void for_each_further(Take&& take) {
  messages::for_each_line<Message>([&](const auto& line) {
    using Line = std::remove_cvref_t<decltype(line)>;
    if constexpr (requires(const Message& message) { Line::value_in(message); }) {
      if (line.format.is_in_files && std::ranges::find(kAbove<Message>, line.name) == kAbove<Message>.end()) take(line);
    }
  });
}

template <class Message>
std::string further_columns() {
  std::string names;
  for_each_further<Message>(
      [&names](const auto& line) { names += "," + std::string(line.format.key.empty() ? line.name : line.format.key); });
  return names;
}

/// Words of files stand for values of enums. What is no number is empty.
template <class Value>
std::string text_of(const Value& value) {
  if constexpr (std::is_same_v<Value, bool>) {
    return value ? "1" : "0";
  } else if constexpr (messages::HasWords<Value>) {
    return messages::is_known(value) ? std::string(messages::key_of(value)) : std::to_string(messages::plain(value));
  } else if constexpr (std::is_unsigned_v<Value>) {
    return std::to_string(value);
  } else if constexpr (std::is_same_v<Value, Time> || std::is_same_v<Value, Duration>) {
    return host::decimals(static_cast<double>(value.us) * 1e-6, 6);
  } else {
    const auto number = static_cast<double>(messages::plain(value));
    return is_finite(number) ? host::shortest(number) : std::string();
  }
}

/// A row in the making.
class Row {
 public:
  Row& cell(std::string_view text) {
    text_ += text_.empty() ? "" : ",";
    text_ += text;
    return *this;
  }
  /// What is no number is empty.
  Row& cell(double number, int places) { return cell(is_finite(number) ? host::decimals(number, places) : std::string()); }
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

/// @param message  nothing: empty cells
template <class Message>
void put_further(Row& row, const std::optional<Message>& message) {
  for_each_further<Message>([&](const auto& line) {
    const auto* const value = message ? std::remove_cvref_t<decltype(line)>::value_in(*message) : nullptr;
    row.cell(value != nullptr ? text_of(*value) : std::string());
  });
}

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
  file_.write(std::string(kHeader) + further_columns<messages::Navigation>() + further_columns<messages::SnrMeasurement>() +
              further_columns<messages::Setpoint>() + further_columns<messages::VehicleStatus>() + further_columns<messages::Health>() +
              ",vehicle_status_age_s\n");
}

void TurnTable::take(const Entry& entry, std::span<const Event> /*events*/) {
  const auto* const record = std::get_if<Record>(&entry);
  if (record == nullptr) return;
  if (!began_) began_ = record->time;
  if (const auto* const input = std::get_if<messages::Input>(&record->content)) note(*input);
  if (const auto* const setpoint = std::get_if<messages::Setpoint>(&record->content)) setpoint_ = *setpoint;
  if (const auto* const health = std::get_if<messages::Health>(&record->content)) write_row(record->time, *health);
}

void TurnTable::note(const messages::Input& input) {
  if (const auto* const fix = std::get_if<messages::Navigation>(&input.value); fix != nullptr && messages::is_usable(*fix)) fix_ = *fix;
  if (const auto* const snr = std::get_if<messages::SnrMeasurement>(&input.value); snr != nullptr && messages::is_possible_snr(snr->snr))
    snr_ = *snr;
  if (const auto* const status = std::get_if<messages::VehicleStatus>(&input.value)) status_ = *status;
}

void TurnTable::write_row(Time time, const messages::Health& health) {
  Row row;
  row.cell(std::to_string(health.turn))
      .cell(host::decimals(seconds_of(time), kMicroseconds))
      .cell((time - *began_).to_seconds(), kMicroseconds)
      .cell(host::is_dated(time) ? utc(time) : "")
      .cell(messages::is_known(health.state) ? messages::to_string(health.state) : text_of(health.state))
      .cell(std::to_string(health.steps_taken))
      .cell(text_of(health.response));
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
  if (status_)
    row.cell(status_->altitude.value, kHundredths).cell(status_->battery_percent, kHundredths);
  else
    row.empty(2);
  row.cell(health.mismatch_bits, kHundredths).cell(health.is_sweeping ? "1" : "0").cell(health.is_found ? "1" : "0");
  put_further(row, fix_);
  put_further(row, snr_);
  put_further(row, setpoint_);
  put_further(row, status_);
  put_further(row, std::optional(health));
  row.cell(status_ ? host::decimals((time - status_->time).to_seconds(), kMicroseconds) : std::string());
  file_.write(row.text() + "\n");
  setpoint_.reset();
  ++rows_;
}

std::string TurnTable::what() const {
  return host::counted(rows_, "turn");
}

}  // namespace earshot::journal
