#include "policy/python/journal_module.hpp"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "firmware/core/units.hpp"
#include "firmware/desk/journal_view/export/fields.hpp"
#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/journal/journal_name.hpp"
#include "firmware/host/journal/reading/record_source.hpp"
#include "firmware/host/text/utc.hpp"
#include "firmware/messages/dictionary/every_message.hpp"
#include "policy/python/boundary/watch.hpp"

namespace earshot::python {
namespace {

namespace py = pybind11;

/// A record on its way to Python, with its fields as JSON.
struct RecordText {
  std::uint32_t number;
  std::int64_t time_us;
  const char* topic;
  std::string fields;
};

struct JournalText {
  std::vector<RecordText> records;
  bool is_bus_log = false;
  bool is_dated = false;
  std::uint64_t missing_records = 0;
  std::uint64_t damaged_bytes = 0;
  bool is_cut = false;
};

void take(const journal::Entry& entry, JournalText& text) {
  if (const auto* const record = std::get_if<journal::Record>(&entry)) {
    text.is_dated = text.is_dated || host::is_dated(record->time);
    text.records.push_back({.number = record->number,
                            .time_us = record->time.us,
                            .topic = journal::topic_of(record->content),
                            .fields = journal::to_line(journal::fields_of(record->content))});
  } else if (const auto* const missing = std::get_if<journal::MissingRecords>(&entry)) {
    text.missing_records += missing->count;
  } else if (const auto* const damaged = std::get_if<journal::DamagedBytes>(&entry)) {
    text.damaged_bytes += damaged->bytes;
  } else if (std::holds_alternative<journal::BusLog>(entry)) {
    text.is_bus_log = true;
  }
}

JournalText text_of(const std::filesystem::path& path, Watch& watch) {
  journal::RecordSource source(host::newest_journal_in(path), host::Accepts::kBusLogs);
  JournalText text;
  while (const std::optional<journal::Entry> entry = source.next()) {
    watch();
    take(*entry, text);
  }
  text.is_cut = source.torn_end().has_value();
  if (text.records.empty()) throw host::BadInput(path.string() + ": not a journal: no record in it");
  return text;
}

py::dict journal_records(const std::filesystem::path& path) {
  Watch watch(py::none{});
  const JournalText text = [&] {
    const py::gil_scoped_release without_python;
    return text_of(path, watch);
  }();
  py::dict by_topic;
  for (const RecordText& record : text.records) {
    watch();
    const py::str topic(record.topic);
    if (!by_topic.contains(topic)) by_topic[topic] = py::list();
    by_topic[topic].cast<py::list>().append(py::make_tuple(record.number, record.time_us, record.fields));
  }
  py::dict result;
  result["records"] = by_topic;
  result["is_bus_log"] = text.is_bus_log;
  result["is_dated"] = text.is_dated;
  result["missing_records"] = text.missing_records;
  result["damaged_bytes"] = text.damaged_bytes;
  result["is_cut"] = text.is_cut;
  return result;
}

template <class Value>
const char* unit_of() {
  if constexpr (std::is_same_v<Value, Meters>) return "m";
  if constexpr (std::is_same_v<Value, MetersPerSecond>) return "m/s";
  if constexpr (std::is_same_v<Value, Radians>) return "rad";
  if constexpr (std::is_same_v<Value, RadiansPerSecond>) return "rad/s";
  if constexpr (std::is_same_v<Value, Decibels>) return "dB";
  if constexpr (std::is_same_v<Value, Hertz>) return "Hz";
  if constexpr (std::is_same_v<Value, Time> || std::is_same_v<Value, Duration>) return "s";
  return "";
}

template <class Line>
const char* unit_of_line() {
  if constexpr (requires { typename Line::Value; }) return unit_of<typename Line::Value>();
  return "";
}

template <class Message>
py::dict fields_of_message() {
  py::dict fields;
  messages::for_each_line<Message>([&](const auto& line) {
    if (!line.format.is_in_files || line.name.empty()) return;
    std::string key(line.format.key.empty() ? line.name : line.format.key);
    if (!line.format.group.empty()) key[line.format.group.size()] = '.';  // "vehicle_turn_radius_m" is that of the vehicle
    fields[py::str(key)] = py::make_tuple(unit_of_line<std::remove_cvref_t<decltype(line)>>(), std::string(line.format.meaning));
  });
  return fields;
}

/// Of each topic its fields: unit and meaning, as the dictionary has them.
py::dict journal_fields() {
  py::dict topics;
  [&]<class... Each>(std::variant<Each...>*) {
    const auto add = [&]<class Message>(const Message&) {
      if constexpr (messages::IsDescribed<Message>)
        topics[py::str(journal::topic_of(journal::Content(Message{})))] = fields_of_message<Message>();
    };
    (add(Each{}), ...);
  }(static_cast<journal::Content*>(nullptr));
  [&]<class... Each>(std::variant<Each...>*) {
    const auto add = [&]<class Message>(const Message& message) {
      messages::Input input{};
      input.value = message;
      if constexpr (messages::IsDescribed<Message>)
        topics[py::str(journal::topic_of(journal::Content(input)))] = fields_of_message<Message>();
    };
    (add(Each{}), ...);
  }(static_cast<decltype(messages::Input::value)*>(nullptr));
  return topics;
}

}  // namespace

void add_journal(py::module_& module) {
  module.def("journal_records", &journal_records, py::arg("path"));
  module.def("journal_fields", &journal_fields);
}

}  // namespace earshot::python
