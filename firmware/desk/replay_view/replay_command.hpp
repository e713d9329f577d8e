#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "firmware/host/file/output_file.hpp"

namespace earshot::replay_view {

struct ReplayCommand {
  std::filesystem::path journal;
  std::uint32_t from_step = 0;
  std::optional<std::filesystem::path> tables = std::nullopt;   ///< what would have been decided by these?
  std::optional<std::filesystem::path> policy = std::nullopt;   ///< what would another have decided?
  std::optional<std::filesystem::path> mission = std::nullopt;  ///< the same
  std::optional<std::filesystem::path> map = std::nullopt;
  std::optional<std::filesystem::path> json = std::nullopt;
  host::Replace replace = host::Replace::kOwnKind;
};

/// Gives the journal to the core again, and says on standard error what is not the same or not there.
/// @return kDone when the journal is whole and every output the same; else kIncomplete. Where another policy or mission parts from it
///         changes nothing in that.
/// @throws host::BadInput when the journal, the policy or the mission is refused, or a file may not be or cannot be written.
[[nodiscard]] int replay(const ReplayCommand& command);

}  // namespace earshot::replay_view
