#include "firmware/host/journal/reading/record_source.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "firmware/host/journal/reading/decode_record.hpp"

namespace earshot::journal {
std::optional<Entry> RecordSource::next() {
  if (waiting_.empty()) {
    host::JournalRecord record;
    if (!reader_.next(record)) return std::nullopt;
    keep(std::move(record));
  }
  Entry entry = std::move(waiting_.front());
  waiting_.pop_front();
  return entry;
}

std::optional<Record> RecordSource::next_record() {
  while (std::optional<Entry> entry = next()) {
    if (auto* const record = std::get_if<Record>(&*entry)) return std::move(*record);
  }
  return std::nullopt;
}

void RecordSource::keep(host::JournalRecord record) {
  const bool was_damaged = reader_.damages().size() > damages_reported_;
  for (; damages_reported_ < reader_.damages().size(); ++damages_reported_) {
    const host::JournalDamage& damage = reader_.damages()[damages_reported_];
    waiting_.emplace_back(damage);
  }
  keep_gap_before(record.number, was_damaged);
  expected_number_ = record.number + 1;
  ++records_;
  const std::string channel = reader_.is_bus_log() ? journalled_channel(record.channel) : record.channel;
  Content content = decode_record(channel, record.time, record.data);
  waiting_.emplace_back(Record{.number = record.number,
                               .time = record.time,
                               .channel = std::move(record.channel),
                               .size_bytes = record.data.size(),
                               .content = std::move(content)});
}

void RecordSource::keep_gap_before(std::uint32_t number, bool was_damaged) {
  // Numbers begin again at 0 after 2^32 - 1: of two that differ the nearer way round is the one that was gone.
  constexpr std::uint32_t kHalfWayRound = std::uint32_t{1} << 31U;
  const std::uint32_t count = number - expected_number_;
  if (count == 0) return;
  if (count >= kHalfWayRound) {
    waiting_.emplace_back(NumbersGoBack{.from = expected_number_ - 1, .to = number});
    return;
  }
  MissingRecords missing{.first = expected_number_, .count = count, .was_damaged = was_damaged};
  if (const int part = reader_.part(); part != part_reported_) {
    missing.parts = reader_.parts_missing_before();
    missing.first_part = part - missing.parts;
    part_reported_ = part;
  }
  waiting_.emplace_back(missing);
}

std::optional<TornEnd> RecordSource::torn_end() const {
  using End = host::JournalReader::End;
  if (reader_.end() == End::kWhole || reader_.damages().size() <= damages_reported_) return std::nullopt;
  const host::JournalDamage& damage = reader_.damages().back();
  return TornEnd{.where = damage, .is_cut = reader_.end() == End::kCut};
}

}  // namespace earshot::journal
