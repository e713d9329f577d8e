#include "firmware/desk/journal_view/export/topic_messages.hpp"

#include <cmath>
#include <utility>
#include <variant>

#include "firmware/desk/journal_view/export/fields.hpp"
#include "firmware/desk/journal_view/export/foxglove.hpp"
#include "firmware/host/journal/words/wording.hpp"

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

TopicMessage message_of(const Topic* topic, const TopicMessage& stamp, const Json& json) {
  return {.topic = topic, .sequence = stamp.sequence, .logged = stamp.logged, .published = stamp.published, .json = to_line(json)};
}

}  // namespace

template <class MakeTopic>
const Topic* TopicMessages::topic(const std::string& name, MakeTopic make_topic) {
  const auto known = topics_.find(name);
  return &(known != topics_.end() ? known : topics_.emplace(name, make_topic(name)).first)->second;
}

std::vector<TopicMessage> TopicMessages::of(const Entry& entry, std::span<const Event> events) {
  std::vector<TopicMessage> messages;
  if (const auto* const record = std::get_if<Record>(&entry)) add_record(*record, messages);
  add_events(events, messages);
  return messages;
}

std::vector<TopicMessage> TopicMessages::of(std::span<const Event> events) {
  std::vector<TopicMessage> messages;
  add_events(events, messages);
  return messages;
}

void TopicMessages::add_record(const Record& record, std::vector<TopicMessage>& messages) {
  const Json fields = fields_of(record.content);
  if (fields.is_null()) return;
  const TopicMessage stamp{.sequence = record.number, .logged = record.time, .published = sender_date(record), .json = {}};
  const std::string kind = topic_of(record.content);
  const Topic* const of_kind = topic("/" + kind, [&](const std::string& name) {
    return Topic{.name = name, .schema_name = "earshot." + kind, .schema = to_line(schema_of(topic_fields(all_fields_of(record.content))))};
  });
  messages.push_back(message_of(of_kind, stamp, without_unknown(topic_fields(fields))));
  const auto* const input = std::get_if<messages::Input>(&record.content);
  const auto* const fix = input != nullptr ? std::get_if<messages::Navigation>(&input->value) : nullptr;
  if (fix != nullptr && messages::is_usable(*fix)) add_fix(*fix, stamp, messages);
}

void TopicMessages::add_fix(const messages::Navigation& fix, const TopicMessage& stamp, std::vector<TopicMessage>& messages) {
  messages.push_back(message_of(topic("/pose",
                                      [](const std::string& name) {
                                        return Topic{name, kPoseSchema.name, kPoseSchema.json};
                                      }),
                                stamp, pose_in_frame(fix)));
  const std::optional<Json> place = plane_ ? location_fix(fix, *plane_) : std::nullopt;
  if (!place) return;
  messages.push_back(message_of(topic("/position",
                                      [](const std::string& name) {
                                        return Topic{name, kLocationSchema.name, kLocationSchema.json};
                                      }),
                                stamp, *place));
}

void TopicMessages::add_events(std::span<const Event> events, std::vector<TopicMessage>& messages) {
  for (const Event& event : events) {
    const Topic* const log = topic("/log", [](const std::string& name) { return Topic{name, kLogSchema.name, kLogSchema.json}; });
    const TopicMessage stamp{.sequence = events_++, .logged = event.time, .published = event.time, .json = {}};
    messages.push_back(message_of(log, stamp, log_of(event)));
  }
}

}  // namespace earshot::journal
