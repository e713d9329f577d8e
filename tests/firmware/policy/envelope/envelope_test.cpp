#include "firmware/policy/envelope/envelope.hpp"

#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "firmware/core/crc32.hpp"

namespace earshot::policy::format {
namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr std::array<Section, 2> kTwo = {{{{'O', 'N', 'E', 'S'}, 1}, {{'T', 'W', 'O', 'S'}, 7}}};
constexpr FileKind kMadeUp{.magic = {'A', 'B', 'C', 'D', 'E', 'F', 'G', 'H'}, .version = 3, .sections = kTwo};
constexpr std::array<std::uint8_t, kPublicKeySize> kKey = {9, 8, 7};

/// A byte in the first section, two in the second.
Bytes made_up() {
  Bytes bytes(1000);
  const Result<std::size_t> size =
      write_file(kMadeUp, kKey, bytes, [](ByteWriter& writer, std::size_t index) { index == 0 ? writer.u8(0x11) : writer.u16(0x2322); });
  EXPECT_TRUE(size.ok());
  bytes.resize(size.ok() ? size.value() : 0);
  return bytes;
}

/// Reads what made_up() holds. @param seen  what the sections held
PolicyComplaint read(const Bytes& bytes, std::array<unsigned, 2>& seen) {
  return read_file(bytes, kMadeUp, [&seen](ByteReader& content, std::size_t index) {
    seen[index] = index == 0 ? unsigned{content.u8()} : unsigned{content.u16()};
    return PolicyFault::kNone;
  });
}

TEST(Envelope, StandsAroundTheSectionsAsTheReadmeSays) {
  const Bytes expected = {'A', 'B', 'C', 'D', 'E', 'F', 'G', 'H', 3, 0, 0,    0,   139, 0, 0, 0,  // magic, version, length
                          'O', 'N', 'E', 'S', 1,   0,   1,   0,   0, 0, 0x11,                     // tag, version, length, content
                          'T', 'W', 'O', 'S', 7,   0,   2,   0,   0, 0, 0x22, 0x23};
  const Bytes bytes = made_up();
  ASSERT_EQ(bytes.size(), expected.size() + 32 + 4 + 64);
  EXPECT_EQ(Bytes(bytes.begin(), bytes.begin() + 39), expected);
  EXPECT_EQ(carried_key(bytes), kKey);
  EXPECT_EQ(size_around(kMadeUp, 3), bytes.size());
}

TEST(Envelope, GivesEachSectionItsContent) {
  std::array<unsigned, 2> seen{};
  EXPECT_TRUE(read(made_up(), seen).is_none());
  EXPECT_EQ(seen, (std::array<unsigned, 2>{0x11, 0x2322}));
}

TEST(Envelope, NamesTheSectionWhoseContentIsWrong) {
  const PolicyComplaint complaint = read_file(made_up(), kMadeUp, [](ByteReader& content, std::size_t index) {
    if (index == 1) return PolicyFault::kBadShape;
    static_cast<void>(content.u8());
    return PolicyFault::kNone;
  });
  EXPECT_EQ(complaint.fault, PolicyFault::kBadShape);
  EXPECT_EQ(complaint.section, kTwo[1].tag);
}

TEST(Envelope, OfAnotherKindIsNotRead) {
  constexpr FileKind kOther{.magic = {'A', 'B', 'C', 'D', 'E', 'F', 'G', 'X'}, .version = 3, .sections = kTwo};
  EXPECT_EQ(complaint_about_envelope(made_up(), kOther).fault, PolicyFault::kBadMagic);
  constexpr FileKind kLater{.magic = kMadeUp.magic, .version = 4, .sections = kTwo};
  EXPECT_EQ(complaint_about_envelope(made_up(), kLater).fault, PolicyFault::kUnknownVersion);
  EXPECT_EQ(complaint_about_envelope(made_up(), kLater).version, 3U);
}

}  // namespace
}  // namespace earshot::policy::format
