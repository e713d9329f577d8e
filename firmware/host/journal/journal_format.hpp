#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "firmware/core/big_endian.hpp"
#include "firmware/core/time.hpp"

namespace earshot::host {

// The bytes of a journal record (journal.hpp), shared by writer and reader.

inline constexpr std::uint32_t kRecordSync = 0xEDA1DA01;
inline constexpr std::string_view kRecordSyncBytes = "\xED\xA1\xDA\x01";  ///< as it stands in a file
inline constexpr std::size_t kRecordHeaderSize = 28;                      ///< sync, checksum, number, time, channel length, data length
inline constexpr std::size_t kCheckedFrom = 8;                            ///< the checksum covers the record from here to its end

/// Writes a field of a record header and moves on to the next.
struct HeaderWriter {
  std::array<std::uint8_t, kRecordHeaderSize>& header;
  std::size_t at = 0;

  void field(std::size_t size, std::uint64_t value) {
    store_big_endian(std::span(header).subspan(at, size), value);
    at += size;
  }
};

/// The header of a record with its checksum.
[[nodiscard]] std::array<std::uint8_t, kRecordHeaderSize> record_header(std::uint32_t number, Time time, std::string_view channel,
                                                                        std::span<const std::uint8_t> data);

/// Of a whole record, as it stands in its header.
[[nodiscard]] std::uint32_t checksum_of_record(std::uint32_t number, Time time, std::string_view channel,
                                               std::span<const std::uint8_t> data);

/// A small record in memory of its own, that goes into the file by itself.
class LoneRecord {
 public:
  static constexpr std::size_t kMostBytes = 192;

  /// @pre it fits
  LoneRecord(std::uint32_t number, Time time, std::string_view channel, std::span<const std::uint8_t> data);
  [[nodiscard]] std::span<const std::uint8_t> bytes() const { return std::span(bytes_).first(size_); }

 private:
  std::array<std::uint8_t, kMostBytes> bytes_{};
  std::size_t size_;
};

}  // namespace earshot::host
