#include "firmware/desk/journal_view/export/mcap_export.hpp"

#include <cmath>
#include <cstdint>
#include <string_view>
#include <variant>
#include <vector>

#include "firmware/desk/journal_view/export/fields.hpp"
#include "firmware/desk/journal_view/export/foxglove.hpp"
#include "firmware/host/journal/words/wording.hpp"
#include "firmware/host/program/version.hpp"
#include "firmware/host/text/numbers.hpp"

namespace earshot::journal {
namespace {

using Json = nlohmann::ordered_json;

/// Without the numbers that are not known: a plot leaves a gap there, and null would be of no type.
Json without_unknown(const Json& object) {
  Json known = Json::object();
  for (const auto& [name, value] : object.items()) {
    if (!value.is_number_float() || std::isfinite(value.get<double>())) known[name] = value;
  }
  return known;
}

/// Those that stand on the topic of a record: what its ports did is on /port_report.
Json topic_fields(Json fields) {
  fields.erase("ports");
  return fields;
}

std::string_view text_of(const std::vector<std::uint8_t>& bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};  // NOLINT: characters are bytes
}

/// The date that a sender gave; the arrival of what bears none.
Time sender_date(const Record& record) {
  const auto* const input = std::get_if<messages::Input>(&record.content);
  if (input == nullptr) return record.time;
  return std::visit(
      [&](const auto& value) {
        if constexpr (requires { value.time; })
          return value.time;
        else
          return record.time;
      },
      input->value);
}

}  // namespace

McapExport::McapExport(const std::filesystem::path& path, const std::optional<n2k::LocalPlane>& plane)
    : file_(path, "Earshot " + program::version()), plane_(plane) {}

template <class MakeSchema>
McapFile::Channel McapExport::channel_of(const std::string& topic, MakeSchema make_schema) {
  const auto known = channels_.find(topic);
  if (known != channels_.end()) return known->second;
  return channels_[topic] = make_schema(topic);
}

void McapExport::write(McapFile::Channel channel, const Stamp& stamp, const Json& json) {
  const std::string line = to_line(json);
  file_.write({.channel = channel, .sequence = stamp.number, .logged = stamp.logged, .published = stamp.published, .json = line});
}

void McapExport::take(const Entry& entry, std::span<const Event> events) {
  if (const auto* const record = std::get_if<Record>(&entry)) {
    attach_flown(*record);
    write_record(*record);
  }
  write_log(events);
}

void McapExport::finish(std::span<const Event> events) {
  write_log(events);
  file_.finish();
}

void McapExport::write_record(const Record& record) {
  const Json fields = fields_of(record.content);
  if (fields.is_null()) return;
  const Stamp stamp{.number = record.number, .logged = record.time, .published = sender_date(record)};
  const std::string name = topic_of(record.content);
  const McapFile::Channel channel = channel_of("/" + name, [&](const std::string& topic) {
    const Json all = topic_fields(all_fields_of(record.content));
    return file_.add_channel(topic, {.name = "earshot." + name, .json = to_line(schema_of(all))});
  });
  write(channel, stamp, without_unknown(topic_fields(fields)));
  const auto* const input = std::get_if<messages::Input>(&record.content);
  const auto* const fix = input != nullptr ? std::get_if<messages::Navigation>(&input->value) : nullptr;
  if (fix != nullptr && messages::is_usable(*fix)) write_fix(*fix, stamp);
}

void McapExport::attach_flown(const Record& record) {
  constexpr std::string_view kBytes = "application/octet-stream";
  if (std::holds_alternative<messages::MissionRecord>(record.content)) {
    const std::string mission = to_line(fields_of(record.content)) + "\n";
    file_.attach({.time = record.time, .name = "mission.json", .media_type = "application/json", .content = mission});
  } else if (const auto* const policy = std::get_if<PolicyBytes>(&record.content)) {
    file_.attach({.time = record.time, .name = "journal.policy", .media_type = kBytes, .content = text_of(policy->bytes)});
  } else if (const auto* const tables = std::get_if<TablesBytes>(&record.content); tables != nullptr && !tables->bytes.empty()) {
    file_.attach({.time = record.time, .name = "journal.tables", .media_type = kBytes, .content = text_of(tables->bytes)});
  }
}

void McapExport::write_fix(const messages::Navigation& fix, const Stamp& stamp) {
  write(channel_of("/pose", [&](const std::string& topic) { return file_.add_channel(topic, kPoseSchema); }), stamp, pose_in_frame(fix));
  const std::optional<Json> place = plane_ ? location_fix(fix, *plane_) : std::nullopt;
  if (place)
    write(channel_of("/position", [&](const std::string& topic) { return file_.add_channel(topic, kLocationSchema); }), stamp, *place);
}

void McapExport::write_log(std::span<const Event> events) {
  for (const Event& event : events) {
    const McapFile::Channel channel = channel_of("/log", [&](const std::string& topic) { return file_.add_channel(topic, kLogSchema); });
    write(channel, {.number = events_++, .logged = event.time, .published = event.time}, log_of(event));
  }
}

std::string McapExport::what() const {
  return host::counted(file_.messages(), "message");
}

}  // namespace earshot::journal
