#pragma once

#include <filesystem>
#include <optional>

#include "firmware/host/safety_record/safety_record.hpp"

namespace earshot::board {

/// How a vehicle stands of whose safety record every copy is damaged, as the newest of the journals says that are numbered after `wanted`:
/// enough to bring it up. Nothing: there is none that can be read, it was ended in order, or nothing was under way in it.
/// Oracle: LostRecord.*, RecordAtSea.*
[[nodiscard]] std::optional<host::SafetyRecord> record_by_journal(const std::filesystem::path& wanted);

}  // namespace earshot::board
