#include "firmware/wire/serial/record_frame.hpp"

#include <algorithm>
#include <cassert>

#include "firmware/core/crc32.hpp"

namespace earshot::wire {
namespace {

void store(std::span<std::uint8_t> bytes, std::uint64_t value) {
  for (std::size_t i = bytes.size(); i-- > 0; value >>= 8U) bytes[i] = static_cast<std::uint8_t>(value);
}

std::uint64_t load(std::span<const std::uint8_t> bytes) {
  std::uint64_t value = 0;
  for (const std::uint8_t byte : bytes) value = (value << 8U) | byte;
  return value;
}

constexpr std::size_t kDateBytes = 8;

}  // namespace

RecordFrame::RecordFrame(Time time, std::string_view channel, std::span<const std::uint8_t> data) {
  assert(channel.size() <= kFrameChannelBytes && data.size() <= kEncodedBytes);
  std::array<std::uint8_t, kFrameBytes> frame;
  store(std::span(frame).first(kDateBytes), static_cast<std::uint64_t>(time.us));
  frame[kDateBytes] = static_cast<std::uint8_t>(channel.size());
  auto* end = std::copy(channel.begin(), channel.end(), frame.data() + kFrameHeadBytes);
  end = std::copy(data.begin(), data.end(), end);
  const auto size = static_cast<std::size_t>(end - frame.data());
  store(std::span(frame).subspan(size, kFrameChecksumBytes), crc32(std::span(frame).first(size)));
  size_ = stuff(std::span(frame).first(size + kFrameChecksumBytes), bytes_);
}

Status read_record_frame(std::span<const std::uint8_t> frame, FramedRecord& record) {
  if (frame.size() < kFrameHeadBytes + kFrameChecksumBytes) return Status::kMalformed;
  const std::size_t checked = frame.size() - kFrameChecksumBytes;
  if (load(frame.subspan(checked)) != crc32(frame.first(checked))) return Status::kMalformed;
  const std::size_t channel_bytes = frame[kDateBytes];
  if (channel_bytes > kFrameChannelBytes || channel_bytes > checked - kFrameHeadBytes) return Status::kMalformed;
  record = {.time = {static_cast<std::int64_t>(load(frame.first(kDateBytes)))},
            .channel = {reinterpret_cast<const char*>(frame.data()) + kFrameHeadBytes, channel_bytes},
            .data = frame.subspan(kFrameHeadBytes + channel_bytes, checked - kFrameHeadBytes - channel_bytes)};
  return Status::kOk;
}

}  // namespace earshot::wire
