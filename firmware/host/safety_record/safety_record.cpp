#include "firmware/host/safety_record/safety_record.hpp"

#include <algorithm>
#include <bit>
#include <string_view>

#include "firmware/core/big_endian.hpp"
#include "firmware/core/crc32.hpp"

namespace earshot::host {
namespace {

constexpr std::string_view kMagic = "EARSHOTR";
constexpr std::uint32_t kFormat = 2;
constexpr std::uint32_t kFormatWithoutOwner = 1;
constexpr std::size_t kOwnerBytes = 8;
constexpr std::size_t kChecksumBytes = 4;
constexpr std::size_t kChecksumAt = kSafetyRecordBytes - kChecksumBytes;

/// Goes through the fields in their order: one list of them for both directions.
struct FieldWriter {
  std::span<std::uint8_t> bytes;
  std::size_t at = 0;

  void number(std::size_t size, std::uint64_t value) {
    store_big_endian(bytes.subspan(at, size), value);
    at += size;
  }
  void operator()(std::uint64_t value) { number(8, value); }
  void operator()(std::uint32_t value) { number(4, value); }
  void operator()(bool value) { number(1, value ? 1 : 0); }
  void operator()(double value) { number(8, std::bit_cast<std::uint64_t>(value)); }
  void operator()(Time value) { number(8, static_cast<std::uint64_t>(value.us)); }
  void operator()(Duration value) { number(8, static_cast<std::uint64_t>(value.us)); }
  void operator()(messages::MissionState value) { number(1, static_cast<std::uint64_t>(value)); }
  void operator()(messages::EndReason value) { number(1, static_cast<std::uint64_t>(value)); }
  void operator()(const SafetyRecord::BootId& value) {
    for (const std::uint8_t byte : value) number(1, byte);
  }
};

struct FieldReader {
  std::span<const std::uint8_t> bytes;
  std::size_t at = 0;

  std::uint64_t number(std::size_t size) {
    const std::uint64_t value = load_big_endian(bytes.subspan(at, size));
    at += size;
    return value;
  }
  void operator()(std::uint64_t& value) { value = number(8); }
  void operator()(std::uint32_t& value) { value = static_cast<std::uint32_t>(number(4)); }
  void operator()(bool& value) { value = number(1) != 0; }
  void operator()(double& value) { value = std::bit_cast<double>(number(8)); }
  void operator()(Time& value) { value.us = static_cast<std::int64_t>(number(8)); }
  void operator()(Duration& value) { value.us = static_cast<std::int64_t>(number(8)); }
  void operator()(messages::MissionState& value) { value = static_cast<messages::MissionState>(number(1)); }
  void operator()(messages::EndReason& value) { value = static_cast<messages::EndReason>(number(1)); }
  void operator()(SafetyRecord::BootId& value) {
    for (std::uint8_t& byte : value) byte = static_cast<std::uint8_t>(number(1));
  }
};

template <class Record, class Field>
void for_each_field(Record& record, std::uint32_t format, Field&& field) {
  field(record.sequence);
  field(record.boot);
  field(record.since_boot);
  field(record.utc);
  field(record.mission_time);
  field(record.journal_crc32);
  field(record.kept_crc32);
  field(record.starts);
  field(record.turn);
  field(record.state);
  field(record.end_reason);
  field(record.is_engaged);
  field(record.is_paused);
  field(record.is_released);
  field(record.is_closed);
  field(record.max_depth.value);
  field(record.max_speed.value);
  field(record.max_time);
  field(record.deepest.value);
  field(record.ascent_speed.value);
  field(record.turn_radius.value);
  if (format == kFormatWithoutOwner) return;
  field(record.owner.computer);
  field(record.owner.folder);
}

bool is_of_one_boot(const SafetyRecord& a, const SafetyRecord& b) {
  return a.boot == b.boot && a.boot != SafetyRecord::BootId{};
}

bool is_later(const SafetyRecord& a, const SafetyRecord& b) {
  return is_of_one_boot(a, b) ? a.since_boot > b.since_boot : a.utc > b.utc;
}

bool has_higher_of_its_flight(const SafetyRecord& record, std::span<const SafetyRecord> records) {
  return std::ranges::any_of(
      records, [&](const SafetyRecord& other) { return other.journal_crc32 == record.journal_crc32 && other.sequence > record.sequence; });
}

}  // namespace

SafetyRecordBytes encoded(const SafetyRecord& record) {
  SafetyRecordBytes bytes{};
  std::copy(kMagic.begin(), kMagic.end(), bytes.begin());
  FieldWriter writer{.bytes = bytes, .at = kMagic.size()};
  writer(kFormat);
  for_each_field(record, kFormat, writer);
  writer(crc32(std::span(bytes).first(kChecksumAt)));
  return bytes;
}

std::optional<SafetyRecord> read_safety_record(std::span<const std::uint8_t> bytes) {
  constexpr std::size_t kFormatEnd = kMagic.size() + 4;
  if (bytes.size() < kFormatEnd || !std::equal(kMagic.begin(), kMagic.end(), bytes.begin())) return std::nullopt;
  FieldReader reader{.bytes = bytes, .at = kMagic.size()};
  std::uint32_t format = 0;
  reader(format);
  if (format != kFormat && format != kFormatWithoutOwner) return std::nullopt;
  const std::size_t checksum_at = format == kFormat ? kChecksumAt : kChecksumAt - kOwnerBytes;
  if (bytes.size() < checksum_at + kChecksumBytes) return std::nullopt;
  if (load_big_endian(bytes.subspan(checksum_at, kChecksumBytes)) != crc32(bytes.first(checksum_at))) return std::nullopt;
  SafetyRecord record;
  for_each_field(record, format, reader);
  if (record.state > messages::MissionState::kAbort || record.end_reason > messages::kLastEndReason) return std::nullopt;
  return record;
}

std::optional<SafetyRecord> newest_of(std::span<const SafetyRecord> records) {
  std::optional<SafetyRecord> newest;
  std::optional<SafetyRecord> under_way;
  for (const SafetyRecord& record : records) {
    if (has_higher_of_its_flight(record, records)) continue;
    if (!newest || is_later(record, *newest)) newest = record;
    if (is_under_way(record) && (!under_way || is_later(record, *under_way))) under_way = record;
  }
  return under_way && !is_of_one_boot(*under_way, *newest) ? under_way : newest;
}

}  // namespace earshot::host
