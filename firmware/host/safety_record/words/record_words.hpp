#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "firmware/host/safety_record/safety_record.hpp"

namespace earshot::host {

/// What a record says, and what earshotd makes of it, for a person who must know how the vehicle stands before it is started again:
/// "safety record, 2026-11-29 14:52:35 UTC: SEARCH, paused, set-points leave; depth at most 350 m; 3 starts. earshotd --resume goes on, or
/// brings the vehicle up". Oracle: RecordWords.*
[[nodiscard]] std::string to_string(const SafetyRecord& record);

/// The same of the record that stands beside a journal, in the copy that every flight has there; nothing: there is none that can be read,
/// or it is of another flight whose journal is there, too. A journal that is gone leaves its record.
[[nodiscard]] std::optional<std::string> safety_record_beside(const std::filesystem::path& journal);

}  // namespace earshot::host
