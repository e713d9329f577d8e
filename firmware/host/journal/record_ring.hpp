#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "firmware/config/capacities.hpp"
#include "firmware/host/journal/journal_format.hpp"

namespace earshot::host {

/// What a record is worth when not all can be kept: a lighter one never takes the room that is kept for a heavier one.
enum class Priority : std::uint8_t {
  kStream,    ///< comes again soon: navigation, SNR, what ports report, health
  kSteering,  ///< what steered the vehicle: set-points, decisions
  kOrder,     ///< what was flown and who ordered what: mission, policy, commands, acknowledgements, a change of state
};
inline constexpr std::size_t kPriorities = 3;

/// A count for each priority.
using PerPriority = std::array<std::uint64_t, kPriorities>;
[[nodiscard]] constexpr std::uint64_t& of(PerPriority& counts, Priority priority) {
  return counts[static_cast<std::size_t>(priority)];
}
[[nodiscard]] constexpr std::uint64_t of(const PerPriority& counts, Priority priority) {
  return counts[static_cast<std::size_t>(priority)];
}

/// Records that wait for the disk, in fixed memory: their bytes one behind the other as they will stand in the file, and beside them the
/// size and the priority of each. It keeps no position: the positions (bytes and records ever put in, bytes ever taken out) belong to those
/// who put in and take out.
class RecordRing {
 public:
  /// How many bytes may wait when a record of this priority is among the newest.
  [[nodiscard]] static constexpr std::uint64_t limit(Priority priority) {
    if (priority == Priority::kOrder) return config::kJournalBufferBytes;
    if (priority == Priority::kSteering) return config::kJournalBufferBytes - config::kJournalOrderReserveBytes;
    return config::kJournalBufferBytes - config::kJournalOrderReserveBytes - config::kJournalSteeringReserveBytes;
  }

  /// Size and priority of a record, in 4 bytes.
  class Record {
   public:
    Record() = default;
    Record(std::size_t size, Priority priority)
        : bits_(static_cast<std::uint32_t>(size * kSizeUnit) | static_cast<std::uint32_t>(priority)) {}
    [[nodiscard]] std::uint32_t size() const { return bits_ / kSizeUnit; }
    [[nodiscard]] Priority priority() const { return static_cast<Priority>(bits_ % kSizeUnit); }

   private:
    static constexpr std::uint32_t kSizeUnit = 4;  ///< the lowest bits are the priority's
    std::uint32_t bits_ = 0;
  };
  static_assert(kPriorities <= 4);

  /// Puts bytes at `position`, and moves it behind them.
  void copy_in(std::uint64_t& position, std::span<const std::uint8_t> bytes);
  /// The bytes from `begin` to `end`, or as many of them as stand in one piece.
  [[nodiscard]] std::span<const std::uint8_t> piece(std::uint64_t begin, std::uint64_t end) const;

  /// The record of this index, counted from the first ever.
  [[nodiscard]] Record& record(std::uint64_t index) { return records_[static_cast<std::size_t>(index % records_.size())]; }

 private:
  std::array<std::uint8_t, config::kJournalBufferBytes> bytes_;
  /// As many as the bytes can hold, however small they are.
  std::array<Record, config::kJournalBufferBytes / (kRecordHeaderSize + 1) + 1> records_;
};

}  // namespace earshot::host
