#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <optional>

#include "firmware/host/journal/journal_reader.hpp"
#include "firmware/host/journal/reading/entry.hpp"

namespace earshot::journal {

/// The entries of a journal in the order of the file, whatever state it is in. Memory does not grow with the journal, but for 16 bytes a
/// place that is damaged.
class RecordSource {
 public:
  /// @throws host::BadInput naming the file if it cannot be read or is no regular file.
  explicit RecordSource(const std::filesystem::path& path, host::Accepts accepts = host::Accepts::kJournals) : reader_(path, accepts) {
    if (reader_.is_bus_log()) waiting_.emplace_back(BusLog{});
  }

  /// Nothing at the file's end. @throws host::BadInput if the disk fails.
  [[nodiscard]] std::optional<Entry> next();

  /// The next record, whatever is missing or damaged before it. @throws likewise
  [[nodiscard]] std::optional<Record> next_record();

  /// Once next() has come to the end: of a journal that is being written more may have come.
  void resume_reading() { reader_.resume_reading(); }

  /// Once next() has come to the end: what stands behind the last record, if anything does.
  [[nodiscard]] std::optional<TornEnd> torn_end() const;

  /// Behind the last record, bytes from the beginning of the file.
  [[nodiscard]] std::uint64_t offset() const { return reader_.offset(); }
  [[nodiscard]] std::uint64_t file_size() const { return reader_.file_size(); }  ///< bytes, when it was opened
  [[nodiscard]] std::uint64_t records() const { return records_; }               ///< whole ones so far
  [[nodiscard]] const host::JournalReader& file() const { return reader_; }

 private:
  void keep(host::JournalRecord record);
  void keep_gap_before(std::uint32_t number, bool was_damaged);

  host::JournalReader reader_;
  std::deque<Entry> waiting_;  ///< a record, behind what was found before it
  std::size_t damages_reported_ = 0;
  int part_reported_ = 1;  ///< of what is missing before it, all was told
  std::uint32_t expected_number_ = 0;
  std::uint64_t records_ = 0;
};

/// Every whole record of a journal, in its order; what is missing or damaged between them is passed over.
/// @param take  called with each `const Record&`. @throws host::BadInput as RecordSource does
template <class Take>
void for_each_record(const std::filesystem::path& path, Take&& take) {
  RecordSource source(path);
  while (const std::optional<Record> record = source.next_record()) take(*record);
}

}  // namespace earshot::journal
