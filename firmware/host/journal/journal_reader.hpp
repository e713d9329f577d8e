#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "firmware/core/time.hpp"
#include "firmware/host/file/input_file.hpp"

namespace earshot::host {

struct JournalRecord {
  std::uint32_t number = 0;  ///< 0 for the first record, and again after 2^32 - 1; a gap says that records were dropped
  Time time;
  std::string channel;
  std::vector<std::uint8_t> data;
};

/// Reads a journal from its beginning, a piece of it at a time: a journal of any size takes 1 MiB of memory. For desktop tools: it
/// allocates.
class JournalReader {
 public:
  enum class End : std::uint8_t {
    kWhole,    ///< the file ends with its last record
    kCut,      ///< the last record is incomplete: the writer was stopped in it
    kCorrupt,  ///< a record does not match its checksum, or there is no record where one should begin
  };

  /// @throws host::BadInput naming the file if it cannot be read or is no regular file.
  explicit JournalReader(const std::filesystem::path& path);

  /// False at the end; end() and offset() then say where and why. @throws host::BadInput if the disk fails.
  [[nodiscard]] bool next(JournalRecord& record);

  [[nodiscard]] End end() const { return end_; }
  /// Where the next record begins (or would), bytes from the beginning of the file.
  [[nodiscard]] std::uint64_t offset() const { return offset_; }
  [[nodiscard]] std::uint64_t file_size() const { return file_.size(); }  ///< bytes, when it was opened

 private:
  /// What comes next, `size` bytes of it or all that is left.
  [[nodiscard]] std::span<const std::uint8_t> look_ahead(std::size_t size);

  host::InputFile file_;
  std::vector<std::uint8_t> window_;
  std::size_t at_ = 0;      ///< in the window: where the next record begins
  std::size_t filled_ = 0;  ///< bytes of the window that hold the file's
  std::uint64_t offset_ = 0;
  End end_ = End::kWhole;
};

}  // namespace earshot::host
