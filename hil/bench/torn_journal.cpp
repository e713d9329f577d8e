#include "hil/bench/torn_journal.hpp"

#include <algorithm>
#include <fstream>
#include <vector>

#include "firmware/host/journal/journal_reader.hpp"
#include "firmware/wire/lcm/channels.hpp"

namespace earshot::hil {
namespace {

/// How far it reaches, in bytes from its beginning: the file is longer, for a journal holds space in advance.
struct Content {
  std::uint64_t end = 0;
  std::vector<std::uint64_t> turns;  ///< behind each of them
};

/// Nobody reads it any more when this returns: user-mode Linux cuts no file that is open for reading.
Content content_of(const std::filesystem::path& journal) {
  Content content;
  host::JournalReader reader(journal);
  for (host::JournalRecord record; reader.next(record);) {
    content.end = reader.offset();
    if (record.channel == wire::kHealthChannel) content.turns.push_back(content.end);
  }
  return content;
}

}  // namespace

std::uint64_t tear_journal(const std::filesystem::path& journal, std::uint64_t bytes) {
  const Content content = content_of(journal);
  const std::uint64_t kept = content.end > bytes ? content.end - bytes : 0;
  if (bytes > 0) std::filesystem::resize_file(journal, kept);
  return static_cast<std::uint64_t>(std::ranges::upper_bound(content.turns, kept) - content.turns.begin());
}

void flip_bit(const std::filesystem::path& journal) {
  const auto middle = static_cast<std::streamoff>(content_of(journal).end / 2);
  std::fstream file;
  file.exceptions(std::ios::failbit | std::ios::badbit);
  file.open(journal, std::ios::in | std::ios::out | std::ios::binary);
  file.seekg(middle);
  const int byte = file.get();
  file.seekp(middle);
  file.put(static_cast<char>(byte ^ 1));
}

}  // namespace earshot::hil
