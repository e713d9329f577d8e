#include "firmware/host/journal/journal_reader.hpp"

#include <algorithm>
#include <span>

#include "firmware/config/capacities.hpp"
#include "firmware/core/crc32.hpp"
#include "firmware/host/journal/journal_format.hpp"
#include "firmware/wire/lcm/lc02.hpp"

namespace earshot::host {

namespace {

constexpr std::size_t kWindow_bytes = std::size_t{1} << 20U;
static_assert(kWindow_bytes >= kRecordHeaderSize + wire::kMaxChannelLength + config::kLcmMessageBytes, "the largest record fits");

}  // namespace

JournalReader::JournalReader(const std::filesystem::path& path) : file_(path, host::kAnySize), window_(kWindow_bytes) {}

std::span<const std::uint8_t> JournalReader::look_ahead(std::size_t size) {
  if (filled_ - at_ < size) {
    std::copy(window_.begin() + static_cast<std::ptrdiff_t>(at_), window_.begin() + static_cast<std::ptrdiff_t>(filled_), window_.begin());
    filled_ -= at_;
    at_ = 0;
    filled_ += file_.read(std::span(window_).subspan(filled_));
  }
  return std::span(window_).subspan(at_, std::min(size, filled_ - at_));
}

bool JournalReader::next(JournalRecord& record) {
  std::span<const std::uint8_t> rest = look_ahead(kRecordHeaderSize);
  const auto stop = [this](End end) {
    end_ = end;
    return false;
  };
  if (rest.empty()) return stop(End::kWhole);
  if (rest.size() < kRecordHeaderSize) return stop(End::kCut);
  if (load(rest.first(4)) != kRecordSync) return stop(End::kCorrupt);
  const std::uint64_t channel_size = load(rest.subspan(20, 4));
  const std::uint64_t data_size = load(rest.subspan(24, 4));
  if (channel_size < 1 || channel_size > wire::kMaxChannelLength || data_size > config::kLcmMessageBytes) return stop(End::kCorrupt);
  const std::uint64_t size = kRecordHeaderSize + channel_size + data_size;
  rest = look_ahead(size);
  if (rest.size() < size) return stop(End::kCut);
  if (load(rest.subspan(4, 4)) != crc32(rest.subspan(kCheckedFrom, size - kCheckedFrom))) return stop(End::kCorrupt);

  const auto channel = rest.subspan(kRecordHeaderSize, channel_size);
  const auto data = rest.subspan(kRecordHeaderSize + channel_size, data_size);
  record.number = static_cast<std::uint32_t>(load(rest.subspan(8, 4)));
  record.time = Time{static_cast<std::int64_t>(load(rest.subspan(12, 8)))};
  record.channel.assign(channel.begin(), channel.end());
  record.data.assign(data.begin(), data.end());
  at_ += size;
  offset_ += size;
  return true;
}

}  // namespace earshot::host
