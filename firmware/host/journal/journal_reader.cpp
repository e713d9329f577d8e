#include "firmware/host/journal/journal_reader.hpp"

#include <algorithm>
#include <optional>
#include <span>

#include "firmware/config/capacities.hpp"
#include "firmware/core/crc32.hpp"
#include "firmware/host/journal/bus_log.hpp"
#include "firmware/host/journal/journal_format.hpp"
#include "firmware/wire/lcm/channels.hpp"
#include "firmware/wire/lcm/lc02.hpp"

namespace earshot::host {

namespace {

constexpr std::size_t kWindow_bytes = std::size_t{1} << 20U;
constexpr std::uint8_t kFirstByteOfSync = kRecordSync >> 24U;
static_assert(kWindow_bytes >= kRecordHeaderSize + wire::kMaxChannelLength + config::kLcmMessageBytes, "the largest record fits");

}  // namespace

JournalReader::JournalReader(const std::filesystem::path& path, Accepts accepts) : file_(path), window_(kWindow_bytes) {
  if (accepts == Accepts::kJournals) return;
  const std::optional<std::size_t> largest = largest_event_of_bus_log(path);
  is_bus_log_ = largest.has_value();
  window_.resize(std::max(kWindow_bytes, largest.value_or(0)));
}

std::span<const std::uint8_t> JournalReader::fill_window(std::size_t size) {
  if (filled_ - at_ < size && !has_all_) {
    std::copy(window_.begin() + static_cast<std::ptrdiff_t>(at_), window_.begin() + static_cast<std::ptrdiff_t>(filled_), window_.begin());
    filled_ -= at_;
    at_ = 0;
    forget_sums();
    filled_ += file_.read(std::span(window_).subspan(filled_));
    has_all_ = filled_ < window_.size();
  }
  return std::span(window_).subspan(at_, std::min(size, filled_ - at_));
}

JournalReader::Found JournalReader::find_record(std::size_t& size) {
  std::span<const std::uint8_t> rest = fill_window(kRecordHeaderSize);
  if (rest.empty()) return Found::kNothing;
  if (rest.size() < kRecordHeaderSize) return Found::kBeginning;
  if (load_big_endian(rest.first(4)) != kRecordSync) return Found::kOther;
  const std::uint64_t channel_size = load_big_endian(rest.subspan(20, 4));
  const std::uint64_t data_size = load_big_endian(rest.subspan(24, 4));
  const std::uint64_t most_data = is_bus_log_ ? window_.size() - kRecordHeaderSize - channel_size : config::kLcmMessageBytes;
  if (channel_size < 1 || channel_size > wire::kMaxChannelLength || data_size > most_data) return Found::kOther;
  size = kRecordHeaderSize + static_cast<std::size_t>(channel_size + data_size);
  rest = fill_window(size);
  if (rest.size() < size) return Found::kBeginning;
  if (is_bus_log_) return load_big_endian(rest.subspan(4, 4)) == 0 ? Found::kRecord : Found::kOther;
  return load_big_endian(rest.subspan(4, 4)) == checksum_of(rest) ? Found::kRecord : Found::kOther;
}

std::uint32_t JournalReader::checksum_of(std::span<const std::uint8_t> record) {
  if (is_doubtful_) return sums_.of(std::span(window_).first(filled_), at_ + kCheckedFrom, at_ + record.size());
  const std::uint32_t sum = crc32(record.subspan(kCheckedFrom));
  checked_bytes_ += record.size() - kCheckedFrom;
  is_doubtful_ = load_big_endian(record.subspan(4, 4)) != sum;
  return sum;
}

void JournalReader::forget_sums() {
  checked_bytes_ += sums_.bytes_gone_through();
  sums_.forget();
  is_doubtful_ = false;
}

bool JournalReader::pass_over(std::uint64_t& passed) {
  const std::span<const std::uint8_t> rest = std::span(window_).subspan(at_, filled_ - at_);
  const auto next = std::find(rest.begin() + 1, rest.end(), kFirstByteOfSync);
  const auto count = static_cast<std::size_t>(next - rest.begin());
  passed += count;
  at_ += count;
  return std::all_of(rest.begin(), next, [](std::uint8_t byte) { return byte == 0; });
}

void JournalReader::keep(std::span<const std::uint8_t> bytes, JournalRecord& record) const {
  const auto channel = bytes.subspan(kRecordHeaderSize, static_cast<std::size_t>(load_big_endian(bytes.subspan(20, 4))));
  const auto data = bytes.subspan(kRecordHeaderSize + channel.size());
  record.number = static_cast<std::uint32_t>(load_big_endian(bytes.subspan(8, 4)));
  record.time = Time{static_cast<std::int64_t>(load_big_endian(bytes.subspan(12, 8)))};
  record.channel.assign(channel.begin(), channel.end());
  record.data.assign(data.begin(), data.end());
}

bool JournalReader::stop(End end, std::uint64_t passed) {
  end_ = end;
  const std::uint64_t left = file_.size() > offset_ ? file_.size() - offset_ : 0;  // a file may grow while it is read
  is_end_damaged_ = passed > 0;
  if (is_end_damaged_) note_damage(std::max(passed, left));
  return false;
}

void JournalReader::note_damage(std::uint64_t bytes) {
  const JournalParts::Place place = file_.place_of(offset_ + 1);  // behind its first byte
  damages_.push_back(
      {.offset = place.offset - 1, .bytes = bytes, .part = file_.are_several() ? place.file.filename().string() : std::string()});
}

void JournalReader::resume_reading() {
  if (is_end_damaged_) damages_.pop_back();
  is_end_damaged_ = false;
  file_.go_to(offset_);
  at_ = filled_ = 0;
  has_all_ = false;
  forget_sums();
  end_ = End::kWhole;
}

bool JournalReader::next(JournalRecord& record) {
  do {
    if (!next_of_parts(record)) return false;
  } while (record.channel == wire::kJournalPartChannel);
  return true;
}

bool JournalReader::next_of_parts(JournalRecord& record) {
  if (is_end_damaged_) return false;  // who asks again at the end hears no other end
  std::size_t size = 0;
  std::uint64_t passed = 0;
  bool is_beginning = false;  // of a record that the file's end cuts off
  bool is_empty = true;
  for (;;) {
    const Found found = find_record(size);
    if (found == Found::kRecord) break;
    if (found == Found::kNothing) return stop(passed == 0 ? End::kWhole : (is_beginning || is_empty ? End::kCut : End::kCorrupt), passed);
    if (passed == 0) is_beginning = found == Found::kBeginning;
    if (passed > kMostPassedOver_bytes) return stop(End::kCorrupt, passed);
    is_empty = pass_over(passed) && is_empty;
  }
  if (passed > 0) note_damage(passed);
  keep(fill_window(size), record);
  at_ += size;
  offset_ += passed + size;
  return true;
}

}  // namespace earshot::host
