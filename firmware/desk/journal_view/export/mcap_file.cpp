#include "firmware/desk/journal_view/export/mcap_file.hpp"

#include <algorithm>
#include <span>

#include "firmware/core/crc32.hpp"

namespace earshot::journal {
namespace {

enum class Opcode : std::uint8_t {
  kHeader = 0x01,
  kFooter = 0x02,
  kSchema = 0x03,
  kChannel = 0x04,
  kMessage = 0x05,
  kChunk = 0x06,
  kMessageIndex = 0x07,
  kChunkIndex = 0x08,
  kAttachment = 0x09,
  kAttachmentIndex = 0x0A,
  kStatistics = 0x0B,
  kSummaryOffset = 0x0E,
  kDataEnd = 0x0F,
};

constexpr std::string_view kMagic = "\x89MCAP0\r\n";
constexpr std::string_view kCompression = "zstd";
constexpr std::size_t kChunk_bytes = std::size_t{1} << 20U;

McapBytes record(Opcode opcode, const McapBytes& content) {
  McapBytes record;
  record.number(static_cast<std::uint8_t>(opcode)).number(std::uint64_t{content.size()}).raw(content.bytes());
  return record;
}

/// A map of numbers, behind its length.
template <class Map>
void put_map(McapBytes& bytes, const Map& map) {
  McapBytes entries;
  for (const auto& [key, value] : map) entries.number(key).number(value);
  bytes.text(entries.bytes());
}

std::uint32_t crc_of(std::string_view bytes, std::uint32_t previous = 0) {
  return crc32({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()}, previous);
}

std::uint64_t nanoseconds_of(Time time) {
  constexpr std::uint64_t kNanosecondsPerMicrosecond = 1000;
  constexpr std::int64_t kMost_us = std::numeric_limits<std::int64_t>::max() / 1000;
  return static_cast<std::uint64_t>(std::clamp<std::int64_t>(time.us, 0, kMost_us)) * kNanosecondsPerMicrosecond;
}

}  // namespace

void McapFile::Span::note(std::uint64_t time_ns) {
  first = std::min(first, time_ns);
  last = std::max(last, time_ns);
}

McapFile::McapFile(const std::filesystem::path& path, std::string_view library) : file_(path) {
  McapBytes header;
  header.text("").text(library);  // no profile
  put(kMagic);
  put(record(Opcode::kHeader, header).bytes());
}

void McapFile::put(std::string_view bytes) {
  file_.write(bytes);
  offset_ += bytes.size();
  crc_ = crc_of(bytes, crc_);
}

McapFile::Channel McapFile::add_channel(std::string_view topic, const Schema& schema) {
  const Channel id = ++last_channel_;
  McapBytes schema_record;
  schema_record.number(id).text(schema.name).text("jsonschema").text(schema.json);
  McapBytes channel_record;
  channel_record.number(id).number(id).text(topic).text("json").text("");  // no metadata
  const McapBytes schema_bytes = record(Opcode::kSchema, schema_record);
  const McapBytes channel_bytes = record(Opcode::kChannel, channel_record);
  chunk_.raw(schema_bytes.bytes()).raw(channel_bytes.bytes());
  schemas_.raw(schema_bytes.bytes());
  channels_.raw(channel_bytes.bytes());
  messages_on_[id] = 0;
  return id;
}

void McapFile::write(const Message& message) {
  const std::uint64_t logged = nanoseconds_of(message.logged);
  McapBytes content;
  content.number(message.channel).number(message.sequence).number(logged).number(nanoseconds_of(message.published)).raw(message.json);
  index_[message.channel].emplace_back(logged, chunk_.size());
  chunk_.raw(record(Opcode::kMessage, content).bytes());
  chunk_span_.note(logged);
  span_.note(logged);
  ++messages_;
  ++messages_on_[message.channel];
  if (chunk_.size() >= kChunk_bytes) end_chunk();
}

void McapFile::attach(const Attachment& attachment) {
  const std::uint64_t time = nanoseconds_of(attachment.time);
  const std::uint64_t size = attachment.content.size();
  McapBytes content;
  content.number(time).number(time).text(attachment.name).text(attachment.media_type).number(size).raw(attachment.content);
  content.number(crc_of(content.bytes()));
  const McapBytes whole = record(Opcode::kAttachment, content);
  McapBytes index;
  index.number(offset_).number(std::uint64_t{whole.size()}).number(time).number(time).number(size);
  index.text(attachment.name).text(attachment.media_type);
  attachment_indexes_.raw(record(Opcode::kAttachmentIndex, index).bytes());
  put(whole.bytes());
  ++attachments_;
}

void McapFile::end_chunk() {
  if (chunk_.size() == 0) return;
  const std::uint64_t size = chunk_.size();
  const std::string_view frame = frames_.compress(chunk_.bytes());
  McapBytes chunk;
  chunk.number(chunk_span_.begin()).number(chunk_span_.last).number(size).number(crc_of(chunk_.bytes())).text(kCompression);
  chunk.number(std::uint64_t{frame.size()}).raw(frame);
  const std::uint64_t start = offset_;
  put(record(Opcode::kChunk, chunk).bytes());
  const std::uint64_t index_start = offset_;
  std::map<Channel, std::uint64_t> index_offsets;
  for (const auto& [channel, entries] : index_) {
    index_offsets[channel] = offset_;
    McapBytes index;
    index.number(channel);
    put_map(index, entries);
    put(record(Opcode::kMessageIndex, index).bytes());
  }
  McapBytes chunk_index;
  chunk_index.number(chunk_span_.begin()).number(chunk_span_.last).number(start).number(index_start - start);
  put_map(chunk_index, index_offsets);
  chunk_index.number(offset_ - index_start).text(kCompression).number(std::uint64_t{frame.size()}).number(size);
  chunk_indexes_.raw(record(Opcode::kChunkIndex, chunk_index).bytes());
  ++chunks_;
  chunk_.clear();
  chunk_span_ = {};
  index_.clear();
}

McapBytes McapFile::statistics() const {
  McapBytes content;
  content.number(messages_).number(last_channel_).number(std::uint32_t{last_channel_});
  content.number(attachments_).number(std::uint32_t{0}).number(chunks_);  // no metadata
  content.number(span_.begin()).number(span_.last);
  put_map(content, messages_on_);
  return record(Opcode::kStatistics, content);
}

void McapFile::finish() {
  end_chunk();
  McapBytes data_end;
  data_end.number(crc_);
  put(record(Opcode::kDataEnd, data_end).bytes());
  crc_ = 0;
  end_summary(offset_);
  put(kMagic);
  file_.commit();
}

void McapFile::end_summary(std::uint64_t summary_start) {
  McapBytes offsets;
  const auto put_group = [&](Opcode opcode, const McapBytes& records) {
    if (records.size() == 0) return;
    McapBytes group;
    group.number(static_cast<std::uint8_t>(opcode)).number(offset_).number(std::uint64_t{records.size()});
    offsets.raw(record(Opcode::kSummaryOffset, group).bytes());
    put(records.bytes());
  };
  put_group(Opcode::kSchema, schemas_);
  put_group(Opcode::kChannel, channels_);
  put_group(Opcode::kStatistics, statistics());
  put_group(Opcode::kChunkIndex, chunk_indexes_);
  put_group(Opcode::kAttachmentIndex, attachment_indexes_);
  const std::uint64_t offsets_start = offset_;
  put(offsets.bytes());
  // The checksum covers the footer up to itself.
  constexpr std::uint64_t kFooter_bytes = 20;
  McapBytes footer;
  footer.number(static_cast<std::uint8_t>(Opcode::kFooter)).number(kFooter_bytes).number(summary_start).number(offsets_start);
  put(footer.bytes());
  McapBytes checksum;
  checksum.number(crc_);
  put(checksum.bytes());
}

}  // namespace earshot::journal
