#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "firmware/core/time.hpp"

namespace earshot::board {

struct JournalRecord {
  std::uint32_t number = 0;  ///< 0 for the first record; a gap says that records were dropped
  Time time;
  std::string channel;
  std::vector<std::uint8_t> data;
};

/// Reads a journal from its beginning. For desktop tools: it allocates.
class JournalReader {
 public:
  enum class End : std::uint8_t {
    kWhole,    ///< the file ends with its last record
    kCut,      ///< the last record is incomplete: the writer was stopped in it
    kCorrupt,  ///< a record does not match its checksum, or there is no record where one should begin
  };

  /// @throws std::system_error naming the file if it cannot be read.
  explicit JournalReader(const std::filesystem::path& path);

  /// False at the end; end() and offset() then say where and why.
  [[nodiscard]] bool next(JournalRecord& record);

  [[nodiscard]] End end() const { return end_; }
  /// Where the next record begins (or would), bytes from the beginning of the file.
  [[nodiscard]] std::size_t offset() const { return offset_; }

 private:
  std::vector<std::uint8_t> bytes_;
  std::size_t offset_ = 0;
  End end_ = End::kWhole;
};

}  // namespace earshot::board
