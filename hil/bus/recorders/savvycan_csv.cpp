#include "hil/bus/recorders/savvycan_csv.hpp"

#include "hil/bus/candump/log_fields.hpp"
#include "hil/bus/recorders/recorded_frame.hpp"

namespace earshot::hil {

bool SavvyCanReader::knows(std::string_view line) {
  return line.starts_with("Time Stamp,ID,Extended,");
}

LineOr SavvyCanReader::read(std::string_view line) {
  if (knows(line)) {
    columns_.clear();
    while (!line.empty()) columns_.emplace_back(take_field(line, ','));
    return Remark{};
  }
  std::string_view time;
  std::string_view bus = "0";
  std::string_view extended;
  std::string data;
  RecordedFrame frame;
  for (const std::string& column : columns_) {
    std::string_view field = take_field(line, ',');
    const std::string_view value = take_word(field);
    if (column == "Time Stamp") time = value;
    if (column == "ID") frame.identifier = value.starts_with("0x") ? value.substr(2) : value;
    if (column == "Extended") extended = value;
    if (column == "Bus") bus = value;
    if (column == "LEN") frame.size = value;
    if (column.starts_with('D') && column != "Dir") data.append(value).append(" ");
  }
  const auto time_us = scaled(time, 0);
  const auto bus_number = number<unsigned>(bus);
  if (!time_us) return "the stamp is no number of microseconds";
  if (!bus_number || *bus_number > 255) return "no number of a bus";
  if (extended != "true" && extended != "false" && extended != "1" && extended != "0") return "Extended is true or false";
  frame.time = Time{*time_us};
  frame.bus = *bus_number;
  frame.is_extended = extended == "true" || extended == "1";
  frame.data = data;
  return entry_of(frame);
}

}  // namespace earshot::hil
