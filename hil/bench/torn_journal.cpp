#include "hil/bench/torn_journal.hpp"

#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/file/printable.hpp"
#include "firmware/host/journal/journal_reader.hpp"

namespace earshot::hil {
namespace {

/// The file is longer than what stands in it: a journal holds space in advance.
std::uint64_t bytes_that_stand_in(const std::filesystem::path& journal) {
  host::JournalReader reader(journal);
  for (host::JournalRecord record; reader.next(record);) continue;
  return reader.offset();
}

}  // namespace

/// No reader may have the file open by now: user-mode Linux then gives all its openings the rights of the first, and cuts nothing (EINVAL).
void tear_journal(const std::filesystem::path& journal, std::uint64_t bytes) {
  const std::uint64_t held = bytes_that_stand_in(journal);
  if (held <= bytes)
    throw host::BadInput(host::printable(journal.string()) + ": has no more than " + std::to_string(bytes) + " bytes to lose");
  std::filesystem::resize_file(journal, held - bytes);
}

}  // namespace earshot::hil
