#include "hil/bench/torn_journal.hpp"

#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/file/printable.hpp"
#include "firmware/host/journal/journal_reader.hpp"

namespace earshot::hil {

/// The file is longer than what stands in it: a journal holds space in advance.
void tear_journal(const std::filesystem::path& journal, std::uint64_t bytes) {
  host::JournalReader reader(journal);
  for (host::JournalRecord record; reader.next(record);) continue;
  if (reader.offset() <= bytes)
    throw host::BadInput(host::printable(journal.string()) + ": has no more than " + std::to_string(bytes) + " bytes to lose");
  std::filesystem::resize_file(journal, reader.offset() - bytes);
}

}  // namespace earshot::hil
