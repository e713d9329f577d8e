#pragma once

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "firmware/desk/journal_view/export/export.hpp"
#include "firmware/host/journal/reading/record_source.hpp"

namespace earshot::journal {

/// Gives an export all of a journal.
inline void export_all(const std::filesystem::path& journal, Export& to) {
  RecordSource source(journal);
  Timeline timeline;
  while (const std::optional<Entry> entry = source.next()) {
    const std::vector<Event> events = timeline.take(*entry);
    to.take(*entry, events);
  }
  to.finish(timeline.finish(source.torn_end()));
}

inline std::string text_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace earshot::journal
