#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "firmware/core/status.hpp"
#include "firmware/core/time.hpp"
#include "firmware/wire/lcm/encoding.hpp"
#include "firmware/wire/serial/cobs.hpp"

namespace earshot::wire {

// A record of a journal on a serial line: date, channel and data, with a CRC-32, as one COBS frame.
//
//   date, us since 1970, 8 bytes big-endian | bytes of the channel's name, 1 | name | data | CRC-32 of all before it, 4 bytes big-endian

/// Bytes of a channel's name, at most.
inline constexpr std::size_t kFrameChannelBytes = 40;
inline constexpr std::size_t kFrameHeadBytes = 9;
inline constexpr std::size_t kFrameChecksumBytes = 4;
/// A frame with the largest message, before it is stuffed.
inline constexpr std::size_t kFrameBytes = kFrameHeadBytes + kFrameChannelBytes + kEncodedBytes + kFrameChecksumBytes;

/// One record as bytes on the line. Holds them itself: nothing is allocated.
class RecordFrame {
 public:
  /// @pre a channel of at most kFrameChannelBytes, data of at most kEncodedBytes
  RecordFrame(Time time, std::string_view channel, std::span<const std::uint8_t> data);
  [[nodiscard]] std::span<const std::uint8_t> bytes() const { return std::span(bytes_).first(size_); }

 private:
  std::array<std::uint8_t, cobs_room(kFrameBytes)> bytes_;
  std::size_t size_ = 0;
};

/// A record that came off the line; it looks at the frame's bytes.
struct FramedRecord {
  Time time;
  std::string_view channel;
  std::span<const std::uint8_t> data;
};

/// Reads a frame that CobsReader put together. kMalformed: too short, or not what its CRC-32 is of.
[[nodiscard]] Status read_record_frame(std::span<const std::uint8_t> frame, FramedRecord& record);

}  // namespace earshot::wire
