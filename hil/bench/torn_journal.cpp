#include "hil/bench/torn_journal.hpp"

#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/file/printable.hpp"
#include "firmware/host/journal/journal_reader.hpp"

namespace earshot::hil {

namespace {

/// The file is longer than what stands in it: a journal holds space in advance.
std::uint64_t end_of_records(const std::filesystem::path& journal) {
  host::JournalReader reader(journal);
  for (host::JournalRecord record; reader.next(record);) continue;
  return reader.offset();
}

}  // namespace

/// It is closed before it is cut: user-mode Linux's hostfs cuts through the descriptor that is open already, and one for reading cannot.
void tear_journal(const std::filesystem::path& journal, std::uint64_t bytes) {
  const std::uint64_t end = end_of_records(journal);
  if (end <= bytes)
    throw host::BadInput(host::printable(journal.string()) + ": has no more than " + std::to_string(bytes) + " bytes to lose");
  std::filesystem::resize_file(journal, end - bytes);
}

}  // namespace earshot::hil
