#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <numeric>
#include <span>
#include <string_view>

#include "firmware/core/status.hpp"
#include "firmware/core/time.hpp"
#include "firmware/host/file/output_file.hpp"
#include "firmware/host/journal/journal_file.hpp"
#include "firmware/host/journal/journal_format.hpp"
#include "firmware/host/journal/record_ring.hpp"
#include "firmware/messages/journal_records.hpp"

namespace earshot::host {

struct JournalOptions {
  /// What append() does when the disk lags so far behind that a record's share of the buffer is full.
  enum class WhenFull : std::uint8_t {
    kDrop,  ///< at sea: lose the record, count it, never wait
    kWait,  ///< in simulation: wait for the writer; nothing is lost while the disk takes anything at all
  } when_full = WhenFull::kDrop;
  /// What a record in the file survives.
  enum class Survives : std::uint8_t {
    kProcess,   ///< the end of this process; the kernel writes to the disk when it likes
    kPowerCut,  ///< a power cut: the writer calls fdatasync after every batch, and the folder's entry is on the disk before the first
  } survives = Survives::kProcess;
  ExistingJournal existing = ExistingJournal::kRefuse;
  JournalLimits limits = {};
};

inline constexpr OutputKind kJournalOutput{"a journal", {kRecordSyncBytes, {}}};  ///< how a journal begins

[[nodiscard]] constexpr messages::LostRecords lost_records(const PerPriority& lost) {
  return {.streams = of(lost, Priority::kStream), .steering = of(lost, Priority::kSteering), .orders = of(lost, Priority::kOrder)};
}

/// Counters of a journal; they only grow.
struct JournalCounters {
  std::uint64_t appended = 0;  ///< records taken into the buffer
  PerPriority lost{};          ///< records that the buffer had no room for, or that were given up on a full disk
  std::uint64_t refused = 0;   ///< records larger than the format or the buffer allows
  /// Writes that the disk did not take or that would have taken of the reserve, tried again every 100 ms with the buffer filling meanwhile,
  /// so that the file has no hole; and failed fdatasync(2) (kPowerCut), after which what was written may not survive a power cut.
  std::uint64_t write_errors = 0;
  std::uint64_t deleted = 0;  ///< journals of earlier flights, for the budget, the oldest first
  int last_deleted = 0;       ///< the number of the last of them (JournalName); 0: none was

  [[nodiscard]] std::uint64_t all_lost() const { return std::accumulate(lost.begin(), lost.end(), std::uint64_t{0}); }
};

/// A record is on the disk within this time, or the journal is in trouble and says so: what a power cut may cost unannounced.
inline constexpr std::chrono::milliseconds kJournalBudget{1000};

/// What is wrong with the disk at present.
enum class JournalTrouble : std::uint8_t {
  kNone,
  kLags,           ///< (kDrop) a record has waited for the disk for longer than kJournalBudget
  kTakesNothing,   ///< the last write took nothing: the disk is full, read-only or broken; what comes waits in the buffer, then is lost
  kMayNotSurvive,  ///< (kPowerCut) a failed fdatasync(2): the kernel may have dropped what was written, and does not try again
};

/// A log of everything that goes in and out of the runtime: an LCM event log (lcm-logplayer, lcm-spy and Python's lcm.EventLog read it),
/// each record of which carries a checksum. append() copies into a fixed buffer; a thread of the journal's own writes it to the file. A
/// file cut at any byte reads back up to its last complete record (JournalReader).
///
///   record: u32 0xEDA1DA01, u32 CRC-32 of all that follows, u32 number, i64 time (us), u32 channel length, u32 data length, channel, data
///   (big-endian)
///
/// In LCM's terms checksum and number together are the 64-bit event number, which its tools do not interpret.
///
/// The file is in the order of append(), without a hole in a record. Ahead of its end space is held on the disk (JournalFile); when no more
/// of it is to be had, the disk is full, and what comes waits in the buffer: streams may have the larger part of it, set-points and
/// decisions a part that streams cannot take, orders a part of their own. Once an order is among what waits, the orders and what steered
/// before them go into the reserve, of which half is kept from what steers, and the streams between them are given up. A record that is
/// given up or finds no room is lost and counted; its number is missing in the file, so that a gap in the numbers says what is missing and
/// where. The last record of a journal that was concluded is its closing record (messages::ClosingRecord), for which there is always room
/// in the reserve: its number, too, shows what is missing before it.
class Journal {
 public:
  /// What is to be replaced may be anything: who has that from a person asks require_writable(path, kJournalOutput, ...) first.
  /// @throws as JournalFile.
  explicit Journal(const std::filesystem::path& path, JournalOptions options = {});
  /// Goes on with a journal that another process began. @param next_number  of the next record
  Journal(JournalFile file, std::uint32_t next_number, JournalOptions options = {});
  /// close().
  ~Journal();

  /// Takes a copy of one record. One thread at a time. kFull: lost. kOutOfRange: empty or overlong channel, or data over
  /// kLcmMessageBytes.
  [[nodiscard]] Status append(Time time, std::string_view channel, std::span<const std::uint8_t> data,
                              Priority priority = Priority::kStream);

  /// Waits until nothing of what was appended waits for the disk. kNotReady if the disk takes nothing.
  [[nodiscard]] Status flush();
  /// How far records are waited for.
  enum class Reach : std::uint8_t {
    kFile,  ///< what they survive then is the end of this process
    kDisk,  ///< what the journal's options say
  };
  /// Likewise, but no longer than `most`, and no further than that. kNotReady also if something still waits then.
  [[nodiscard]] Status flush(std::chrono::milliseconds most, Reach reach = Reach::kDisk);

  /// From the next record on another file is written, as when a part is full. Never waits.
  void begin_part();

  /// From now on close() ends the file with this record; what was lost is filled in by close(). Of the appending thread.
  void conclude(const messages::ClosingRecord& closing);

  /// Writes what is left, ends the thread and closes the file; nothing can be appended afterwards. Of what does not fit on the disk the
  /// heaviest records are written, the older before the newer, whole ones only; the others are lost and counted. kNotReady if not
  /// everything could be written, or (kPowerCut) brought to the disk.
  [[nodiscard]] Status close();

  [[nodiscard]] JournalCounters counters() const;
  /// Never waits.
  [[nodiscard]] JournalTrouble trouble() const;
  /// The longest that a record which is in the file waited for it, and (kPowerCut) for the disk, seconds: so much would have been lost had
  /// the power failed then.
  [[nodiscard]] double longest_wait_s() const;
  /// The first file of it.
  [[nodiscard]] const std::filesystem::path& path() const;

 private:
  struct Writer;
  std::unique_ptr<Writer> writer_;
};

}  // namespace earshot::host
