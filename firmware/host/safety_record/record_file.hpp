#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "firmware/host/file/file_descriptor.hpp"
#include "firmware/host/file/folder_lock.hpp"
#include "firmware/host/safety_record/safety_record.hpp"

namespace earshot::host {

/// Bytes of a record's file: two slots, each in a block of the disk of its own, and behind them what is kept beside the records.
inline constexpr std::size_t kRecordSlotBytes = 4096;
inline constexpr std::size_t kRecordSlots = 2;
inline constexpr std::size_t kRecordFileBytes = 65'536;
/// Of what is kept beside the records, at most.
inline constexpr std::size_t kMostKeptBytes = kRecordFileBytes - kRecordSlots * kRecordSlotBytes;

/// One copy of a vehicle's safety record: a file that is made whole once and then written in place, its slots in turn, so that a disk which
/// is full later still takes it, and a write that the power cuts off costs the record before none of its bytes, where the
/// disk writes blocks of a slot's size whole (the pages of eMMC and SD cards are larger). A bit that flips costs one slot at most.
///
/// Of one thread at a time. Nothing allocates but kept(), holder() and the constructor.
/// Oracle: RecordFile.*
class RecordFile {
 public:
  explicit RecordFile(std::filesystem::path path);

  /// Opens the file that is there, to be read and, where the disk lets it, written; where it does not, once it does. False: there is none,
  /// or it is not of this kind (no regular file), or others than root and this program's user own it or may write it: then it
  /// is_anybodys().
  bool open();
  [[nodiscard]] bool is_anybodys() const { return is_anybodys_; }
  /// Why open() did not come to see whether there is one, as errno says it (no descriptor is left); 0: it did.
  [[nodiscard]] int out_of_reach() const { return out_of_reach_; }
  /// Something bears its name that open() did not take: anybody's file, a folder, a pipe, a link, or what this user or this disk lets
  /// nobody read. A vehicle may be under way.
  [[nodiscard]] bool is_unreadable() const { return is_unreadable_; }
  /// What a file that is_anybodys() states: true of nothing but of whom it is.
  [[nodiscard]] const std::optional<SafetyRecord>& unbelieved() const { return unbelieved_; }
  /// Marks it as this process's, as long as this is kept. False: another process has it, which may only read it (marked_by()).
  [[nodiscard]] bool claim();
  /// The newest record that is whole. Reads it anew.
  [[nodiscard]] std::optional<SafetyRecord> newest() const;
  /// What is kept beside the records, as of the checksum that they name; nothing: it is damaged, or of another flight.
  [[nodiscard]] std::vector<std::uint8_t> kept(std::uint32_t crc32) const;

  /// Makes the file, or all of its space on the disk, and puts into it what is to be kept. What a record says in it stays.
  [[nodiscard]] bool prepare(std::span<const std::uint8_t> kept);
  /// Writes the record into the slot that does not hold the newest, and brings it to the disk. Only of a file that prepare() made or open()
  /// found.
  [[nodiscard]] bool write(const SafetyRecord& record);
  /// Whether write() has met a record of the same flight that this process did not write.
  [[nodiscard]] bool is_overtaken() const { return is_overtaken_; }
  /// Whether the file still bears its name and has its whole length: somebody may have removed it, put another in its place or cut it.
  [[nodiscard]] bool is_in_place() const;
  [[nodiscard]] bool is_open() const { return file_.number() >= 0; }
  /// As if it had not been opened.
  void let_go();

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  /// Who has it that another process's claim is.
  [[nodiscard]] MarkedBy marked_by() const;
  /// Likewise; for a message.
  [[nodiscard]] std::string holder() const;

 private:
  struct Found {
    SafetyRecord record;
    std::size_t slot = 0;
  };

  [[nodiscard]] FileDescriptor opened_to(int access);
  [[nodiscard]] bool is_to_be_written();
  [[nodiscard]] static std::optional<Found> newest_slot(int file);
  [[nodiscard]] bool hold_space() const;
  [[nodiscard]] bool holds(std::span<const std::uint8_t> kept) const;
  [[nodiscard]] bool put(const SafetyRecord& record, std::size_t slot) const;

  std::filesystem::path path_;
  std::filesystem::path folder_;
  FileDescriptor file_;
  int out_of_reach_ = 0;
  bool is_anybodys_ = false;
  bool is_unreadable_ = false;
  std::optional<SafetyRecord> unbelieved_;
  bool is_writable_ = false;
  bool is_claimed_ = false;
  bool is_overtaken_ = false;
};

}  // namespace earshot::host
