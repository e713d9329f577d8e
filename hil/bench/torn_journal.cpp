#include "hil/bench/torn_journal.hpp"

#include "firmware/host/journal/journal_name.hpp"
#include "firmware/host/journal/journal_reader.hpp"
#include "firmware/wire/lcm/channels.hpp"

namespace earshot::hil {

std::filesystem::path newest_journal(const std::filesystem::path& folder) {
  const std::filesystem::path wanted = folder / "journal.lcmlog";
  return host::newest_journal(wanted).value_or(wanted);
}

/// The file is longer than what stands in it: a journal holds space in advance.
std::uint64_t tear_journal(const std::filesystem::path& journal, std::uint64_t bytes) {
  host::JournalReader reader(journal);
  std::uint64_t end = 0;
  for (host::JournalRecord record; reader.next(record);) end = reader.offset();
  const std::uint64_t kept = end > bytes ? end - bytes : 0;
  host::JournalReader again(journal);
  std::uint64_t turns = 0;
  for (host::JournalRecord record; again.next(record) && again.offset() <= kept;) {
    if (record.channel == wire::kHealthChannel) ++turns;
  }
  std::filesystem::resize_file(journal, kept);
  return turns;
}

}  // namespace earshot::hil
