#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <vector>

#include "firmware/boards/linux/replay/playback.hpp"
#include "firmware/core/time.hpp"
#include "firmware/host/journal/journal_reader.hpp"
#include "firmware/messages/journal_records.hpp"

namespace earshot::board {

struct ReplayOptions {
  std::uint32_t from_step = 0;  ///< outputs are compared from the turn on that decides this step
  /// Called now and then with how much of the file is done, 0 to 1.
  std::function<void(double fraction)> progress = nullptr;
};

/// The outcome of giving a journal to the runtime again.
struct ReplayResult {
  std::uint64_t inputs = 0;
  std::size_t turns = 0;
  std::size_t decisions = 0;
  bool was_compared = false;  ///< the decision was made from which on outputs are compared
  Time began;                 ///< of the first record
  Time ended;                 ///< of the last turn or input that was given
  /// The first record that the runtime does not give again; nothing when it gives them all.
  std::optional<Playback::Difference> difference;
  /// Number of the first record that is missing, because it is damaged, or the disk was full or too slow: the journal is whole up to it,
  /// and what follows was not replayed. One that is missing at the end is found by the closing record behind it.
  std::optional<std::uint32_t> gap;
  /// The journal's last record; nothing when its end is missing, because earshotd was killed or lost its power.
  std::optional<messages::ClosingRecord> closing;
  std::size_t records_behind_end = 0;  ///< which are no part of the journal: another was written, or copied, behind it
  host::JournalReader::End end = host::JournalReader::End::kWhole;
  std::vector<host::JournalDamage> damages;  ///< bytes of the file that are no record

  [[nodiscard]] bool is_same() const { return !difference && !gap; }
};

/// Gives a fresh runtime the inputs of a journal again and compares every output with what stands in it. The journal alone is needed: it
/// begins with the mission and the policy.
/// @throws std::system_error when it cannot be read, host::BadInput when it does not begin so or its policy is damaged.
[[nodiscard]] ReplayResult replay(const std::filesystem::path& journal, const ReplayOptions& options = {});

}  // namespace earshot::board
