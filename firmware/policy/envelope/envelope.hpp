#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "firmware/core/status.hpp"
#include "firmware/policy/envelope/byte_stream.hpp"
#include "firmware/policy/envelope/policy_fault.hpp"

namespace earshot::policy {

inline constexpr std::size_t kSignatureSize = 64;  ///< Ed25519, over every byte before it; the shell checks it, the core does not
inline constexpr std::size_t kPublicKeySize = 32;

}  // namespace earshot::policy

// What all our signed files have around their content: a header, tagged sections in one order, a trailer. format/README.md shows the
// bytes.
namespace earshot::policy::format {

inline constexpr std::size_t kMagicSize = 8;
inline constexpr std::size_t kLengthAt = 12;
inline constexpr std::size_t kHeaderSize = 16;         // magic, version, length
inline constexpr std::size_t kSectionHeaderSize = 10;  // tag, version, length
inline constexpr std::size_t kChecksumSize = 4;
inline constexpr std::size_t kTrailerSize = kPublicKeySize + kChecksumSize + kSignatureSize;

struct Section {
  SectionTag tag;
  std::uint16_t version;
};

/// `.policy` or `.tables`.
struct FileKind {
  std::array<std::uint8_t, kMagicSize> magic;
  std::uint32_t version;
  std::span<const Section> sections;  ///< all of them, in their order in the file
};

/// Bytes of the largest file of a kind. @param most_content  of all its sections together
[[nodiscard]] constexpr std::size_t size_around(const FileKind& kind, std::size_t most_content) {
  return kHeaderSize + kind.sections.size() * kSectionHeaderSize + most_content + kTrailerSize;
}

/// Magic, version, length and checksum: are these the bytes of a whole file of the kind, of our version?
[[nodiscard]] PolicyComplaint complaint_about_envelope(std::span<const std::uint8_t> bytes, const FileKind& kind);

/// Takes the next section. @param index  of the section that is due  @param content  out: what it holds
[[nodiscard]] PolicyComplaint take_section(ByteReader& reader, const FileKind& kind, std::size_t index, ByteReader& content);

/// What stands behind the last section, if anything does.
[[nodiscard]] PolicyComplaint complaint_about_rest(ByteReader& reader, const FileKind& kind);

/// Reads a file, section by section.
/// @param read_content  PolicyFault(ByteReader& content, std::size_t index); past the end of the content it reads zeros
template <class ReadContent>
[[nodiscard]] PolicyComplaint read_file(std::span<const std::uint8_t> bytes, const FileKind& kind, ReadContent read_content) {
  if (const PolicyComplaint complaint = complaint_about_envelope(bytes, kind); !complaint.is_none()) return complaint;
  ByteReader reader(bytes.subspan(kHeaderSize, bytes.size() - kHeaderSize - kTrailerSize));
  for (std::size_t i = 0; i < kind.sections.size(); ++i) {
    ByteReader content(std::span<const std::uint8_t>{});
    if (const PolicyComplaint complaint = take_section(reader, kind, i, content); !complaint.is_none()) return complaint;
    if (const PolicyFault fault = read_content(content, i); fault != PolicyFault::kNone)
      return {.fault = fault, .section = kind.sections[i].tag};
    const bool is_used_up = content.remaining() == 0 && !content.past_end();
    if (!is_used_up) return {.fault = PolicyFault::kBadSectionLength, .section = kind.sections[i].tag};
  }
  return complaint_about_rest(reader, kind);
}

/// The public half of the key that a file says it was signed with. @param bytes  of a whole file
[[nodiscard]] inline std::array<std::uint8_t, kPublicKeySize> carried_key(std::span<const std::uint8_t> bytes) {
  std::array<std::uint8_t, kPublicKeySize> key{};
  const std::span<const std::uint8_t> trailer = bytes.last(kTrailerSize);
  for (std::size_t i = 0; i < key.size(); ++i) key[i] = trailer[i];
  return key;
}

/// Header; the length of the file follows with end_file().
void begin_file(ByteWriter& writer, const FileKind& kind);
/// Tag and version. @return where its content begins, for end_section()
[[nodiscard]] std::size_t begin_section(ByteWriter& writer, const Section& section);
void end_section(ByteWriter& writer, std::size_t begin);
/// Public key, CRC-32, and a signature of zeros, which the shell writes over.
/// @param bytes  those that `writer` writes to  @return how many were written; kFull where they are too few
[[nodiscard]] Result<std::size_t> end_file(ByteWriter& writer, std::span<const std::uint8_t, kPublicKeySize> public_key,
                                           std::span<const std::uint8_t> bytes);

/// Writes a file, section by section. @param write_content  void(ByteWriter&, std::size_t index)
template <class WriteContent>
[[nodiscard]] Result<std::size_t> write_file(const FileKind& kind, std::span<const std::uint8_t, kPublicKeySize> public_key,
                                             std::span<std::uint8_t> bytes, WriteContent write_content) {
  ByteWriter writer(bytes);
  begin_file(writer, kind);
  for (std::size_t i = 0; i < kind.sections.size(); ++i) {
    const std::size_t begin = begin_section(writer, kind.sections[i]);
    write_content(writer, i);
    end_section(writer, begin);
  }
  return end_file(writer, public_key, bytes);
}

}  // namespace earshot::policy::format
