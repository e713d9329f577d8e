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
#include "firmware/host/safety_record/safety_record.hpp"

namespace earshot::host {

/// Bytes of a record's file: two slots, each in a block of the disk of its own, and behind them what is kept beside the records.
inline constexpr std::size_t kRecordSlotBytes = 4096;
inline constexpr std::size_t kRecordSlots = 2;
inline constexpr std::size_t kRecordFileBytes = 65'536;
/// Of what is kept beside the records, at most.
inline constexpr std::size_t kMostKeptBytes = kRecordFileBytes - kRecordSlots * kRecordSlotBytes;

/// One copy of a vehicle's safety record: a file that is made whole once and then written in place, its slots in turn, so that a disk which
/// is full later still takes it, and a write that the power cuts off costs the record before none of its bytes. A bit that flips costs one
/// slot at most.
///
/// Of one thread at a time. Nothing allocates but kept() and the constructor.
/// Oracle: RecordFile.*
class RecordFile {
 public:
  explicit RecordFile(std::filesystem::path path);

  /// Opens the file that is there, to be read and, where the disk lets it, written. False: there is none, or it is not of this kind (no
  /// regular file).
  bool open();
  /// Marks it as this process's, as long as this is kept. False: another process has it.
  [[nodiscard]] bool claim();
  /// The newest record that is whole. Reads it anew.
  [[nodiscard]] std::optional<SafetyRecord> newest();
  /// What is kept beside the records, as of the checksum that they name; nothing: it is damaged, or of another flight.
  [[nodiscard]] std::vector<std::uint8_t> kept(std::uint32_t crc32) const;

  /// Makes the file, or all of its space on the disk, and puts into it what is to be kept. What a record says in it stays.
  [[nodiscard]] bool prepare(std::span<const std::uint8_t> kept);
  /// Writes the record into the slot that does not hold the newest, and brings it to the disk. Only of a file that prepare() made or open()
  /// found.
  [[nodiscard]] bool write(const SafetyRecord& record);

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  /// Who has it that another process's claim is; for a message.
  [[nodiscard]] std::string holder() const;

 private:
  [[nodiscard]] bool hold_space() const;

  std::filesystem::path path_;
  std::filesystem::path folder_;
  FileDescriptor file_;
  std::size_t newest_slot_ = kRecordSlots - 1;
};

}  // namespace earshot::host
