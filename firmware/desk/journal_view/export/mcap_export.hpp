#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>

#include "firmware/desk/journal_view/export/export.hpp"
#include "firmware/desk/journal_view/export/mcap_file.hpp"
#include "firmware/desk/journal_view/export/topic_messages.hpp"
#include "firmware/wire/n2k/local_plane.hpp"

namespace earshot::journal {

/// A journal as an MCAP file of TopicMessages.
/// What was flown is attached, as it stands in the journal: mission.json (the fields of /mission), journal.policy and journal.tables.
class McapExport final : public Export {
 public:
  /// @param plane  about the mission's origin; none: no /position
  McapExport(const std::filesystem::path& path, const std::optional<n2k::LocalPlane>& plane);
  void take(const Entry& entry, std::span<const Event> events) override;
  void finish(std::span<const Event> events) override;
  [[nodiscard]] std::string what() const override;

 private:
  void write(std::span<const TopicMessage> messages);
  void attach_flown(const Record& record);

  McapFile file_;
  TopicMessages messages_;
  std::map<const Topic*, McapFile::Channel> channels_;
};

}  // namespace earshot::journal
