#include "firmware/desk/journal_view/export/mcap_export.hpp"

#include <cstdint>
#include <string_view>
#include <variant>
#include <vector>

#include "firmware/desk/journal_view/export/fields.hpp"
#include "firmware/host/program/version.hpp"
#include "firmware/host/text/numbers.hpp"

namespace earshot::journal {
namespace {

std::string_view text_of(const std::vector<std::uint8_t>& bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};  // NOLINT: characters are bytes
}

}  // namespace

McapExport::McapExport(const std::filesystem::path& path, const std::optional<n2k::LocalPlane>& plane)
    : file_(path, "Earshot " + program::version()), messages_(plane) {}

void McapExport::take(const Entry& entry, std::span<const Event> events) {
  if (const auto* const record = std::get_if<Record>(&entry)) attach_flown(*record);
  write(messages_.of(entry, events));
}

void McapExport::finish(std::span<const Event> events) {
  write(messages_.of(events));
  file_.finish();
}

void McapExport::write(std::span<const TopicMessage> messages) {
  for (const TopicMessage& message : messages) {
    auto channel = channels_.find(message.topic);
    if (channel == channels_.end()) {
      const Topic& topic = *message.topic;
      channel = channels_.emplace(&topic, file_.add_channel(topic.name, {.name = topic.schema_name, .json = topic.schema})).first;
    }
    file_.write({.channel = channel->second,
                 .sequence = message.sequence,
                 .logged = message.logged,
                 .published = message.published,
                 .json = message.json});
  }
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

std::string McapExport::what() const {
  return host::counted(file_.messages(), "message");
}

}  // namespace earshot::journal
