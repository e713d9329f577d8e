#include "firmware/wire/serial/record_frame.hpp"

#include <algorithm>
#include <cassert>

#include "firmware/core/big_endian.hpp"
#include "firmware/core/crc32.hpp"

namespace earshot::wire {
namespace {

constexpr std::size_t kDateBytes = 8;

}  // namespace

RecordFrame::RecordFrame(Time time, std::string_view channel, std::span<const std::uint8_t> data) {
  assert(channel.size() <= kFrameChannelBytes && data.size() <= kEncodedBytes);
  const std::size_t checked = kFrameHeadBytes + channel.size() + data.size();
  const std::span<std::uint8_t> room = std::span(bytes_).first(cobs_room(checked + kFrameChecksumBytes));
  const std::span<std::uint8_t> frame = room.last(checked + kFrameChecksumBytes);
  store_big_endian(frame.first(kDateBytes), static_cast<std::uint64_t>(time.us));
  frame[kDateBytes] = static_cast<std::uint8_t>(channel.size());
  std::copy(data.begin(), data.end(), std::copy(channel.begin(), channel.end(), frame.begin() + kFrameHeadBytes));
  store_big_endian(frame.last(kFrameChecksumBytes), crc32(frame.first(checked)));
  size_ = stuff(frame, room);
}

Status read_record_frame(std::span<const std::uint8_t> frame, FramedRecord& record) {
  if (frame.size() < kFrameHeadBytes + kFrameChecksumBytes) return Status::kMalformed;
  const std::size_t checked = frame.size() - kFrameChecksumBytes;
  if (load_big_endian(frame.subspan(checked)) != crc32(frame.first(checked))) return Status::kMalformed;
  const std::size_t channel_bytes = frame[kDateBytes];
  if (channel_bytes > kFrameChannelBytes || channel_bytes > checked - kFrameHeadBytes) return Status::kMalformed;
  record = {.time = {static_cast<std::int64_t>(load_big_endian(frame.first(kDateBytes)))},
            .channel = {reinterpret_cast<const char*>(frame.data()) + kFrameHeadBytes, channel_bytes},
            .data = frame.subspan(kFrameHeadBytes + channel_bytes, checked - kFrameHeadBytes - channel_bytes)};
  return Status::kOk;
}

}  // namespace earshot::wire
