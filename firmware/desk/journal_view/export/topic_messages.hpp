#pragma once

#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "firmware/core/time.hpp"
#include "firmware/desk/journal_view/events/timeline.hpp"
#include "firmware/host/journal/reading/entry.hpp"
#include "firmware/messages/navigation.hpp"
#include "firmware/wire/n2k/local_plane.hpp"

namespace earshot::journal {

/// Messages of one kind, as Foxglove and Lichtblick know them: JSON, described by a JSON schema.
struct Topic {
  std::string name;         ///< "/snr"
  std::string schema_name;  ///< "earshot.snr"
  std::string schema;
};

struct TopicMessage {
  const Topic* topic = nullptr;  ///< lives as long as the TopicMessages that gave it
  std::uint32_t sequence = 0;
  Time logged;
  Time published;  ///< the date that its sender gave; of what bears none `logged`
  std::string json;
};

/// What viewers are given of a journal. Every record is a message on a topic of its kind (/navigation, /snr, /setpoint, /health, ...) with
/// the fields of fields_of(), numbers that are not known left out; beside them /pose and, where the mission's origin is known, /position of
/// every usable fix, and the timeline as /log.
class TopicMessages {
 public:
  /// @param plane  about the mission's origin; none: no /position
  explicit TopicMessages(const std::optional<n2k::LocalPlane>& plane) : plane_(plane) {}

  /// Of one entry, in the order of their meaning. @param events  what happened with it
  [[nodiscard]] std::vector<TopicMessage> of(const Entry& entry, std::span<const Event> events);
  /// Of what is known at the journal's end alone.
  [[nodiscard]] std::vector<TopicMessage> of(std::span<const Event> events);

 private:
  template <class MakeTopic>
  [[nodiscard]] const Topic* topic(const std::string& name, MakeTopic make_topic);
  void add_record(const Record& record, std::vector<TopicMessage>& messages);
  void add_fix(const messages::Navigation& fix, const TopicMessage& stamp, std::vector<TopicMessage>& messages);
  void add_events(std::span<const Event> events, std::vector<TopicMessage>& messages);

  std::optional<n2k::LocalPlane> plane_;
  std::map<std::string, Topic> topics_;
  std::uint32_t events_ = 0;
};

}  // namespace earshot::journal
