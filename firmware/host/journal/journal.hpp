#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string_view>

#include "firmware/core/status.hpp"
#include "firmware/core/time.hpp"
#include "firmware/host/file/output_file.hpp"

namespace earshot::host {

struct JournalOptions {
  /// What append() does when the disk lags so far behind that the buffer is full.
  enum class WhenFull : std::uint8_t {
    kDrop,  ///< at sea: lose the record, count it, never wait
    kWait,  ///< in simulation: wait for the writer; nothing is lost while the disk takes anything at all
  } when_full = WhenFull::kDrop;
  /// What a record in the file survives.
  enum class Survives : std::uint8_t {
    kProcess,   ///< the end of this process; the kernel writes to the disk when it likes
    kPowerCut,  ///< a power cut: the writer calls fdatasync after every batch, and the folder's entry is on the disk before the first
  } survives = Survives::kProcess;
  /// What becomes of a file of that name.
  enum class Existing : std::uint8_t {
    kRefuse,
    kReplace,
    kKeep,  ///< at sea: it stays, and this journal is NAME-2, NAME-3, ... so that a process that died can be started again
  } existing = Existing::kRefuse;
};

inline constexpr OutputKind kJournalOutput{"a journal", {"\xED\xA1\xDA\x01", {}}};  ///< how a journal begins

/// Counters of a journal; they only grow.
struct JournalCounters {
  std::uint64_t appended = 0;  ///< records taken into the buffer
  std::uint64_t dropped = 0;   ///< records lost because the buffer was full
  std::uint64_t refused = 0;   ///< records larger than the format or the buffer allows
  /// Failed write(2), tried again every 100 ms with the buffer filling meanwhile, so that the file has no hole; and failed fdatasync(2)
  /// (kPowerCut), after which what was written may not survive a power cut.
  std::uint64_t write_errors = 0;
};

/// A log of everything that goes in and out of the runtime: an LCM event log (lcm-logplayer, lcm-spy and Python's lcm.EventLog read it),
/// each record of which carries a checksum. append() copies into a fixed buffer; a thread of the journal's own writes it to the file. A
/// file cut at any byte reads back up to its last complete record (JournalReader).
///
///   record: u32 0xEDA1DA01, u32 CRC-32 of all that follows, u32 number, i64 time (us), u32 channel length, u32 data length, channel, data
///   (big-endian)
///
/// In LCM's terms checksum and number together are the 64-bit event number, which its tools do not interpret.
class Journal {
 public:
  /// What is to be replaced may be anything: who has that from a person asks require_writable(path, kJournalOutput, ...) first.
  /// @throws std::system_error naming the file if it cannot be created (or exists: kRefuse).
  explicit Journal(const std::filesystem::path& path, JournalOptions options = {});
  /// close().
  ~Journal();

  /// Takes a copy of one record. One thread at a time. kFull: dropped. kOutOfRange: empty or overlong channel, or data over
  /// kLcmMessageBytes.
  [[nodiscard]] Status append(Time time, std::string_view channel, std::span<const std::uint8_t> data);

  /// Waits until everything appended is written. kNotReady if the disk takes nothing.
  [[nodiscard]] Status flush();

  /// Writes what is left, ends the thread and closes the file; nothing can be appended afterwards. kNotReady if not everything could be
  /// written, or (kPowerCut) brought to the disk.
  [[nodiscard]] Status close();

  [[nodiscard]] JournalCounters counters() const;
  /// Of the file that is written.
  [[nodiscard]] const std::filesystem::path& path() const;

 private:
  struct Writer;
  std::unique_ptr<Writer> writer_;
};

}  // namespace earshot::host
