#include "hil/bench/torn_journal.hpp"

#include <algorithm>
#include <optional>

#include "firmware/host/journal/journal_reader.hpp"
#include "firmware/wire/lcm/channels.hpp"

namespace earshot::hil {
namespace {

struct Extent {
  std::uint64_t first_turn = 0;  ///< bytes of all up to its end; without a turn: of all
  std::uint64_t all = 0;         ///< the file is longer: a journal holds space in advance
};

Extent extent_of(const std::filesystem::path& journal) {
  host::JournalReader reader(journal);
  std::optional<std::uint64_t> first_turn;
  for (host::JournalRecord record; reader.next(record);) {
    if (!first_turn && record.channel == wire::kHealthChannel) first_turn = reader.offset();
  }
  return {.first_turn = first_turn.value_or(reader.offset()), .all = reader.offset()};
}

}  // namespace

/// Nobody has the file open then: user-mode Linux would cut it through that descriptor, and cannot if it only reads.
void tear_journal(const std::filesystem::path& journal, std::uint64_t bytes) {
  const Extent extent = extent_of(journal);
  std::filesystem::resize_file(journal, extent.all - std::min(bytes, extent.all - extent.first_turn));
}

}  // namespace earshot::hil
