#include "firmware/policy/envelope/envelope.hpp"

#include <algorithm>

#include "firmware/core/crc32.hpp"

namespace earshot::policy::format {
namespace {

SectionTag read_tag(ByteReader& reader) {
  const auto letter = [&reader] { return static_cast<char>(reader.u8()); };
  return {letter(), letter(), letter(), letter()};
}

/// What a section that is not the next one says about the order. @param next  of the section that is due; all are there: past the last
PolicyComplaint complaint_about_order(SectionTag tag, const FileKind& kind, std::size_t next) {
  const std::span<const Section> all = kind.sections;
  const auto known = std::find_if(all.begin(), all.end(), [tag](const Section& section) { return section.tag == tag; });
  if (known == all.end()) return {.fault = PolicyFault::kUnknownSection, .section = tag};
  if (known - all.begin() < static_cast<std::ptrdiff_t>(next)) return {.fault = PolicyFault::kSectionTwice, .section = tag};
  return {.fault = PolicyFault::kMissingSection, .section = all[next].tag};
}

}  // namespace

PolicyComplaint complaint_about_envelope(std::span<const std::uint8_t> bytes, const FileKind& kind) {
  if (bytes.size() < kHeaderSize) return {.fault = PolicyFault::kTooShort};
  if (!std::equal(kind.magic.begin(), kind.magic.end(), bytes.begin())) return {.fault = PolicyFault::kBadMagic};
  ByteReader reader(bytes.subspan(kMagicSize));
  const std::uint32_t version = reader.u32();
  if (version != kind.version) return {.fault = PolicyFault::kUnknownVersion, .version = version};
  const std::size_t length = reader.u32();
  if (bytes.size() < length || length < kHeaderSize + kTrailerSize) return {.fault = PolicyFault::kTooShort};
  if (bytes.size() > length) return {.fault = PolicyFault::kTooLong};
  const std::size_t covered = length - kSignatureSize - kChecksumSize;
  ByteReader checksum(bytes.subspan(covered));
  return {.fault = checksum.u32() == crc32(bytes.first(covered)) ? PolicyFault::kNone : PolicyFault::kBadChecksum};
}

PolicyComplaint take_section(ByteReader& reader, const FileKind& kind, std::size_t index, ByteReader& content) {
  const Section& due = kind.sections[index];
  if (reader.remaining() == 0) return {.fault = PolicyFault::kMissingSection, .section = due.tag};
  const SectionTag tag = read_tag(reader);
  if (tag != due.tag) return complaint_about_order(tag, kind, index);
  const std::uint16_t version = reader.u16();
  if (version != due.version) return {.fault = PolicyFault::kUnknownSectionVersion, .section = tag, .version = version};
  content = reader.take(reader.u32());
  if (reader.past_end()) return {.fault = PolicyFault::kBadSectionLength, .section = tag};
  return {};
}

PolicyComplaint complaint_about_rest(ByteReader& reader, const FileKind& kind) {
  if (reader.remaining() == 0) return {};
  return complaint_about_order(read_tag(reader), kind, kind.sections.size());
}

void begin_file(ByteWriter& writer, const FileKind& kind) {
  for (const std::uint8_t byte : kind.magic) writer.u8(byte);
  writer.u32(kind.version);
  writer.u32(0);
}

std::size_t begin_section(ByteWriter& writer, const Section& section) {
  for (const char letter : section.tag) writer.u8(static_cast<std::uint8_t>(letter));
  writer.u16(section.version);
  writer.u32(0);
  return writer.position();
}

void end_section(ByteWriter& writer, std::size_t begin) {
  if (!writer.full()) writer.u32_at(begin - sizeof(std::uint32_t), static_cast<std::uint32_t>(writer.position() - begin));
}

Result<std::size_t> end_file(ByteWriter& writer, std::span<const std::uint8_t, kPublicKeySize> public_key,
                             std::span<const std::uint8_t> bytes) {
  for (const std::uint8_t byte : public_key) writer.u8(byte);
  const std::size_t covered = writer.position();
  if (bytes.size() < covered + kChecksumSize + kSignatureSize) return Status::kFull;
  writer.u32_at(kLengthAt, static_cast<std::uint32_t>(covered + kChecksumSize + kSignatureSize));
  writer.u32(crc32(bytes.first(covered)));
  for (std::size_t i = 0; i < kSignatureSize; ++i) writer.u8(0);
  return writer.position();
}

}  // namespace earshot::policy::format
