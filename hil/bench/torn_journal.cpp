#include "hil/bench/torn_journal.hpp"

#include <algorithm>
#include <optional>

#include "firmware/host/journal/journal_reader.hpp"
#include "firmware/wire/lcm/channels.hpp"

namespace earshot::hil {

/// The file is longer than what stands in it: a journal holds space in advance.
void tear_journal(const std::filesystem::path& journal, std::uint64_t bytes) {
  host::JournalReader reader(journal);
  std::optional<std::uint64_t> first_turn;
  for (host::JournalRecord record; reader.next(record);) {
    if (!first_turn && record.channel == wire::kHealthChannel) first_turn = reader.offset();
  }
  const std::uint64_t kept = first_turn.value_or(reader.offset());
  std::filesystem::resize_file(journal, reader.offset() - std::min(bytes, reader.offset() - kept));
}

}  // namespace earshot::hil
