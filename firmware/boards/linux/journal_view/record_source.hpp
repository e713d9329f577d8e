#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <optional>

#include "firmware/boards/linux/journal_view/entry.hpp"
#include "firmware/host/journal/journal_reader.hpp"

namespace earshot::journal_view {

/// The entries of a journal in the order of the file, whatever state it is in: the only place here that reads the file. Memory does not
/// grow with the journal, but for 16 bytes a place that is damaged.
class RecordSource {
 public:
  /// @throws host::BadInput naming the file if it cannot be read or is no regular file.
  explicit RecordSource(const std::filesystem::path& path) : reader_(path, host::Accepts::kBusLogs) {
    if (reader_.is_bus_log()) waiting_.emplace_back(BusLog{});
  }

  /// Nothing at the file's end. @throws host::BadInput if the disk fails.
  [[nodiscard]] std::optional<Entry> next();

  /// Once next() has come to the end: of a journal that is being written more may have come.
  void look_again() { reader_.look_again(); }

  /// Once next() has come to the end: what stands behind the last record, if anything does.
  [[nodiscard]] std::optional<TornEnd> torn_end() const;

  /// Behind the last record, bytes from the beginning of the file.
  [[nodiscard]] std::uint64_t offset() const { return reader_.offset(); }
  [[nodiscard]] std::uint64_t file_size() const { return reader_.file_size(); }  ///< bytes, when it was opened
  [[nodiscard]] std::uint64_t records() const { return records_; }               ///< whole ones so far

 private:
  void keep(host::JournalRecord record);
  void keep_gap_before(std::uint32_t number, bool was_damaged);

  host::JournalReader reader_;
  std::deque<Entry> waiting_;  ///< a record, behind what was found before it
  std::size_t damages_told_ = 0;
  int part_told_ = 1;  ///< of what is missing before it, all was told
  std::uint32_t expected_number_ = 0;
  std::uint64_t records_ = 0;
};

}  // namespace earshot::journal_view
