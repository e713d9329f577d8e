#include "firmware/boards/linux/journal_reader.hpp"

#include <cerrno>
#include <fstream>
#include <iterator>
#include <span>
#include <system_error>

#include "firmware/boards/linux/journal_format.hpp"
#include "firmware/config/capacities.hpp"
#include "firmware/core/crc32.hpp"
#include "firmware/wire/lcm/lc02.hpp"

namespace earshot::board {

JournalReader::JournalReader(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (std::filesystem::is_directory(path)) throw std::system_error(EISDIR, std::generic_category(), path.string());
  if (!file) throw std::system_error(errno, std::generic_category(), path.string());
  bytes_.assign(std::istreambuf_iterator<char>(file), {});
}

bool JournalReader::next(JournalRecord& record) {
  const std::span<const std::uint8_t> rest = std::span(bytes_).subspan(offset_);
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
  if (rest.size() < size) return stop(End::kCut);
  if (load(rest.subspan(4, 4)) != crc32(rest.subspan(kCheckedFrom, size - kCheckedFrom))) return stop(End::kCorrupt);

  const auto channel = rest.subspan(kRecordHeaderSize, channel_size);
  const auto data = rest.subspan(kRecordHeaderSize + channel_size, data_size);
  record.number = static_cast<std::uint32_t>(load(rest.subspan(8, 4)));
  record.time = Time{static_cast<std::int64_t>(load(rest.subspan(12, 8)))};
  record.channel.assign(channel.begin(), channel.end());
  record.data.assign(data.begin(), data.end());
  offset_ += size;
  return true;
}

}  // namespace earshot::board
