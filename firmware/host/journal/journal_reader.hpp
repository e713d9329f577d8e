#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "firmware/core/time.hpp"
#include "firmware/host/journal/journal_parts.hpp"
#include "firmware/host/journal/range_checksum.hpp"

namespace earshot::host {

struct JournalRecord {
  std::uint32_t number = 0;  ///< 0 for the first record, and again after 2^32 - 1; a gap says that records were dropped
  Time time;
  std::string channel;
  std::vector<std::uint8_t> data;
};

/// Bytes of a journal that are no record: torn by a power cut, flipped, written over.
struct JournalDamage {
  std::uint64_t offset = 0;  ///< bytes from the beginning of the file
  std::uint64_t bytes = 0;
  std::string part = {};  ///< name of the file, of a journal that has several parts
  friend bool operator==(const JournalDamage&, const JournalDamage&) = default;
};

/// What a reader takes for a journal.
enum class Accepts : std::uint8_t {
  kJournals,
  kBusLogs,  ///< what lcm-logger wrote, too: whatever was on a bus, without a checksum
};

/// Reads a journal from its beginning, through all of its parts (JournalParts), a piece of it at a time: a journal of any size takes 1 MiB
/// of memory, a damaged one at most 9 MiB. Where no record matches its checksum it reads on at the next that does, and remembers what it
/// passed over: damage costs the records that it hit, and no others. For desktop tools, and for a vehicle before its first turn: it
/// allocates.
class JournalReader {
 public:
  enum class End : std::uint8_t {
    kWhole,    ///< the file ends with a record
    kCut,      ///< the last record is incomplete, or what stands behind it is empty: the writer was stopped in it, or lost its power
    kCorrupt,  ///< what stands behind the last record is none, and no record follows
  };
  /// Without a record for so many bytes it gives up: a file of holes may be larger than anybody can wait for.
  static constexpr std::uint64_t kMostPassedOver_bytes = std::uint64_t{64} << 20U;

  /// @throws host::BadInput naming the file if it cannot be read or is no regular file.
  explicit JournalReader(const std::filesystem::path& path, Accepts accepts = Accepts::kJournals);
  /// It is lcm-logger's.
  [[nodiscard]] bool is_bus_log() const { return is_bus_log_; }

  /// False at the end; end(), offset() and damages() then say where and why. @throws host::BadInput if the disk fails.
  [[nodiscard]] bool next(JournalRecord& record);

  /// Behind the last record, once next() has come to the end: whoever follows a journal that is being written asks next() again then. An
  /// end that was damaged may be whole by now. @throws host::BadInput if the disk fails.
  void resume_reading();

  [[nodiscard]] End end() const { return end_; }
  /// Behind the last record that was read, bytes from the beginning of the first part.
  [[nodiscard]] std::uint64_t offset() const { return offset_; }
  [[nodiscard]] std::uint64_t file_size() const { return file_.size(); }  ///< bytes of all parts, when it was opened
  /// Number of the part where the last record stands, and how many are missing right before it.
  [[nodiscard]] int part() const { return file_.place_of(offset_).part; }
  [[nodiscard]] int parts_missing_before() const { return file_.missing_before(offset_); }
  /// What was passed over so far, in the order of the file; at the end, the end's own damage too (kCut, kCorrupt).
  [[nodiscard]] const std::vector<JournalDamage>& damages() const { return damages_; }
  /// What the checksums cost so far: at most three times the bytes that were read, whatever they are.
  [[nodiscard]] std::uint64_t checked_bytes() const { return checked_bytes_ + sums_.bytes_gone_through(); }

 private:
  enum class Found : std::uint8_t { kRecord, kNothing, kBeginning, kOther };

  /// What comes next, `size` bytes of it or all that is left.
  [[nodiscard]] std::span<const std::uint8_t> fill_window(std::size_t size);
  /// What stands where the window is. @param size  of the record
  [[nodiscard]] Found find_record(std::size_t& size);
  /// Of a record that stands where the window is.
  [[nodiscard]] std::uint32_t checksum_of(std::span<const std::uint8_t> record);
  void forget_sums();
  /// To the next byte that could begin a record. @return whether all that was passed was zero
  bool pass_over(std::uint64_t& passed);
  void keep(std::span<const std::uint8_t> bytes, JournalRecord& record) const;
  /// The record that a part begins with, too.
  [[nodiscard]] bool next_of_parts(JournalRecord& record);
  bool stop(End end, std::uint64_t passed);
  void note_damage(std::uint64_t bytes);

  JournalParts file_;
  bool is_bus_log_ = false;
  std::vector<std::uint8_t> window_;
  std::size_t at_ = 0;               ///< in the window: what is looked at
  std::size_t filled_ = 0;           ///< bytes of the window that hold the file's
  bool has_all_ = false;             ///< the file's end stands in the window
  RangeChecksum sums_;               ///< of the window, once something in it began like a record and was none: many more may
  bool is_doubtful_ = false;         ///< that has happened
  std::uint64_t checked_bytes_ = 0;  ///< but those of sums_
  std::uint64_t offset_ = 0;
  std::vector<JournalDamage> damages_;
  bool is_end_damaged_ = false;  ///< the last of damages_ is the end's
  End end_ = End::kWhole;
};

}  // namespace earshot::host
