#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "firmware/config/mission.hpp"
#include "firmware/core/time.hpp"
#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/journal/journal_reader.hpp"
#include "firmware/policy/frozen_policy.hpp"
#include "firmware/policy/tables/ocean_tables.hpp"

namespace earshot::board {

/// Which mission is flown, and by what.
struct Flown {
  config::Mission mission;
  std::uint32_t policy_crc32 = 0;  ///< of the whole .policy file
  std::uint32_t tables_crc32 = 0;  ///< of the whole .tables file; 0: none
};

/// What a journal was flown with: its first kBeginningRecords records.
struct Beginning {
  Time time;  ///< of the first record
  Flown flown;
  std::unique_ptr<policy::FrozenPolicy> policy;
  std::unique_ptr<policy::OceanTables> tables;  ///< without an ocean where there are none
};

inline constexpr std::uint32_t kBeginningRecords = 3;  ///< mission, policy, tables

/// Reads them. Whether this build repeats the policy's golden trajectories is not looked at.
/// @param reader  that has read nothing yet
/// @throws host::BadInput naming the journal when it does not begin so, or one of them is not what the mission's record says
[[nodiscard]] Beginning read_beginning(host::JournalReader& reader, const std::filesystem::path& journal);

/// "JOURNAL: cannot be replayed: WHY"
[[nodiscard]] host::BadInput not_replayable(const std::filesystem::path& journal, const std::string& why);

}  // namespace earshot::board
