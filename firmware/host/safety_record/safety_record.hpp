#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "firmware/core/time.hpp"
#include "firmware/core/units.hpp"
#include "firmware/messages/health.hpp"

namespace earshot::host {

/// Whose a record is. 0: not known.
struct RecordOwner {
  std::uint32_t computer = 0;  ///< checksum of what this computer is told by
  std::uint32_t folder = 0;    ///< of the path of the folder of its flights

  friend bool operator==(const RecordOwner&, const RecordOwner&) = default;
};

/// Nothing that both know is different.
[[nodiscard]] constexpr bool may_be_same(const RecordOwner& a, const RecordOwner& b) {
  const auto may_be = [](std::uint32_t x, std::uint32_t y) { return x == 0 || y == 0 || x == y; };
  return may_be(a.computer, b.computer) && may_be(a.folder, b.folder);
}

/// What a vehicle must not forget, whatever becomes of its journal: plain data of fixed size.
struct SafetyRecord {
  using BootId = std::array<std::uint8_t, 16>;

  std::uint64_t sequence = 0;  ///< of two records of one flight the one with the higher counts; from 1

  // When it was written, by three clocks that belong together.
  BootId boot{};        ///< of this start of the computer, as the kernel drew it; nothing but zeros: not known
  Duration since_boot;  ///< CLOCK_BOOTTIME
  Time utc;
  Time mission_time;

  // Which flight it is of.
  std::uint32_t journal_crc32 = 0;  ///< checksum of the first record of its journal, which names mission, policy and the moment it began
  std::uint32_t kept_crc32 = 0;     ///< of what the vehicle needs to come up, which stands beside it (RecordFile)
  std::uint32_t starts = 0;         ///< of the program in this flight since it last flew for a while

  // How it stands.
  std::uint64_t turn = 0;
  messages::MissionState state = messages::MissionState::kStandby;
  messages::EndReason end_reason = messages::EndReason::kNone;
  bool is_engaged = false;    ///< set-points leave
  bool is_paused = false;     ///< by an operator
  bool is_released = false;   ///< the drop weight was asked to be released
  bool is_closed = false;     ///< the program was stopped in order: nothing is under way any more
  Meters max_depth;           ///< as flown: an operator may have tightened it
  MetersPerSecond max_speed;  ///< likewise, of the search
  Duration max_time;          ///< likewise

  // What is needed to bring it up, though all else were lost.
  Meters deepest;                ///< that it may be
  MetersPerSecond ascent_speed;  ///< that it needs to come up; 0: none
  Meters turn_radius;

  RecordOwner owner;  ///< not known of a record of format 1

  friend bool operator==(const SafetyRecord&, const SafetyRecord&) = default;
};

/// The vehicle searches, or is commanded (on its way up, too), and nobody has stopped the program: somebody must go on with it.
[[nodiscard]] constexpr bool is_under_way(const SafetyRecord& record) {
  return !record.is_closed && (record.is_engaged || record.state == messages::MissionState::kSearch);
}

/// Of records that may be of several flights, as copies that were away for a while hold them, the one that says how the vehicle stands. Of
/// one flight it is the one with the highest sequence. Of several flights it is the latest; but one that is under way counts before a later
/// one that is not, unless both are of one start of the computer, whose clock tells for certain. Oracle: NewestRecord.*
[[nodiscard]] std::optional<SafetyRecord> newest_of(std::span<const SafetyRecord> records);

/// A record as it stands in a file: "EARSHOTR", the format's number (2; 1 has no owner), the fields big-endian, and the CRC-32 of all that.
inline constexpr std::size_t kSafetyRecordBytes = 146;
using SafetyRecordBytes = std::array<std::uint8_t, kSafetyRecordBytes>;

[[nodiscard]] SafetyRecordBytes encoded(const SafetyRecord& record);
/// Of either format. Nothing: these bytes are no record, or a bit of them has flipped.
/// Oracle: SafetyRecord.*
[[nodiscard]] std::optional<SafetyRecord> read_safety_record(std::span<const std::uint8_t> bytes);

}  // namespace earshot::host
