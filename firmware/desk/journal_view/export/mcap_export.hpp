#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "firmware/desk/journal_view/export/export.hpp"
#include "firmware/desk/journal_view/export/mcap_file.hpp"
#include "firmware/messages/navigation.hpp"
#include "firmware/wire/n2k/local_plane.hpp"

namespace earshot::journal {

/// A journal as an MCAP file. Every record is a message on a topic of its kind (/navigation, /snr, /setpoint, /health, ...) with the fields
/// of fields_of(), numbers that are not known left out; beside them /pose and, where the mission's origin is known, /position of every
/// usable fix, and the timeline as /log. A message's log time is the record's, its publish time the date that its sender gave.
/// What was flown is attached, as it stands in the journal: mission.json (the fields of /mission), journal.policy and journal.tables.
class McapExport final : public Export {
 public:
  /// @param plane  about the mission's origin; none: no /position
  McapExport(const std::filesystem::path& path, const std::optional<n2k::LocalPlane>& plane);
  void take(const Entry& entry, std::span<const Event> events) override;
  void finish(std::span<const Event> events) override;
  [[nodiscard]] std::string what() const override;

 private:
  struct Stamp {
    std::uint32_t number = 0;
    Time logged;
    Time published;
  };

  /// The topic's channel, made when its first message comes.
  template <class MakeSchema>
  [[nodiscard]] McapFile::Channel channel_of(const std::string& topic, MakeSchema make_schema);
  void write(McapFile::Channel channel, const Stamp& stamp, const nlohmann::ordered_json& json);
  void write_fix(const messages::Navigation& fix, const Stamp& stamp);
  void write_record(const Record& record);
  void attach_flown(const Record& record);
  void write_log(std::span<const Event> events);

  McapFile file_;
  std::optional<n2k::LocalPlane> plane_;
  std::map<std::string, McapFile::Channel> channels_;
  std::uint32_t events_ = 0;
};

}  // namespace earshot::journal
