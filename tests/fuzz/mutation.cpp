#include "tests/fuzz/mutation.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <limits>
#include <span>

#include "firmware/core/crc32.hpp"
#include "firmware/policy/format/sections.hpp"

namespace earshot::fuzz {
namespace {

using namespace policy::format;

/// Where a section lies: header and content.
struct Piece {
  std::size_t begin;
  std::size_t end;
};

template <class Value>
void put(Bytes& bytes, std::size_t at, Value value) {
  const auto raw = std::bit_cast<std::array<std::uint8_t, sizeof(Value)>>(value);
  for (std::size_t i = 0; i < raw.size() && at + i < bytes.size(); ++i) bytes[at + i] = raw[i];
}

std::size_t below(std::size_t count, Pcg32& random) {
  return random.next() % std::max<std::size_t>(count, 1);
}

/// Those that can still be told apart.
std::vector<Piece> pieces_of(const Bytes& bytes) {
  std::vector<Piece> pieces;
  const std::size_t end = bytes.size() - kTrailerSize;
  std::size_t at = kHeaderSize;
  while (at + kSectionHeaderSize <= end) {
    std::size_t length = 0;
    for (std::size_t i = 0; i < 4; ++i) length |= std::size_t{bytes[at + 6 + i]} << (8U * i);
    const std::size_t next = at + kSectionHeaderSize + length;
    if (next > end) break;
    pieces.push_back({at, next});
    at = next;
  }
  return pieces;
}

Piece any_piece(const Bytes& bytes, Pcg32& random) {
  const std::vector<Piece> pieces = pieces_of(bytes);
  if (pieces.empty()) return {kHeaderSize, bytes.size() - kTrailerSize};
  return pieces[below(pieces.size(), random)];
}

/// One that holds some numbers, where there is one.
Piece piece_of_numbers(const Bytes& bytes, Pcg32& random) {
  Piece piece = any_piece(bytes, random);
  for (int i = 0; i < 8 && piece.end - piece.begin < kSectionHeaderSize + 32; ++i) piece = any_piece(bytes, random);
  return piece;
}

void change_bytes(Bytes& bytes, Pcg32& random) {
  const Piece piece = any_piece(bytes, random);
  for (std::size_t i = 1 + below(4, random); i > 0; --i)
    bytes[piece.begin + below(piece.end - piece.begin, random)] = static_cast<std::uint8_t>(random.next());
}

void flip_a_bit(Bytes& bytes, Pcg32& random) {
  bytes[below(bytes.size() - kTrailerSize, random)] ^= static_cast<std::uint8_t>(1U << below(8, random));
}

bool is(const Bytes& bytes, Piece piece, policy::SectionTag tag) {
  return std::equal(tag.begin(), tag.end(), bytes.begin() + static_cast<std::ptrdiff_t>(piece.begin));
}

/// Where in a section a float may lie: mostly where one does.
std::size_t float_in(const Bytes& bytes, Piece piece, Pcg32& random) {
  const std::size_t content = piece.begin + kSectionHeaderSize;
  const std::size_t size = piece.end - content;
  if (is(bytes, piece, policy::kNetworkSection)) return content + 7 + 4 * below(size / 4, random);
  if (is(bytes, piece, policy::kBeliefSection)) return content + 12 + 4 * below(7, random);
  if (is(bytes, piece, policy::kObservationSection)) return content + 28 + 10 * below(size / 10, random) + 2 + 4 * below(2, random);
  return content + below(size, random);
}

/// Likewise of a double.
std::size_t double_in(const Bytes& bytes, Piece piece, Pcg32& random) {
  const std::size_t content = piece.begin + kSectionHeaderSize;
  if (is(bytes, piece, policy::kBeliefSection)) return content + 4;
  if (is(bytes, piece, policy::kObservationSection)) return content + 8 * below(3, random);
  if (is(bytes, piece, policy::kActionsSection) && random.next() % 2 == 0) return content;
  return content + below(piece.end - content, random);
}

void put_a_float(Bytes& bytes, Pcg32& random) {
  using Limits = std::numeric_limits<float>;
  constexpr std::array kFloats = {Limits::quiet_NaN(),
                                  Limits::signaling_NaN(),
                                  Limits::infinity(),
                                  -Limits::infinity(),
                                  Limits::max(),
                                  Limits::lowest(),
                                  Limits::min(),
                                  Limits::denorm_min(),
                                  0.0F,
                                  -0.0F,
                                  1.0F,
                                  -1.0F,
                                  1e-3F,
                                  1e6F,
                                  -1e6F,
                                  1e9F,
                                  9e29F,
                                  -9e29F,
                                  1e30F,
                                  100.0F,
                                  0.05F,
                                  -10.0F};
  const Piece piece = piece_of_numbers(bytes, random);
  put(bytes, float_in(bytes, piece, random), kFloats[below(kFloats.size(), random)]);
}

void put_a_double(Bytes& bytes, Pcg32& random) {
  using Limits = std::numeric_limits<double>;
  constexpr std::array kDoubles = {Limits::quiet_NaN(),
                                   Limits::infinity(),
                                   -Limits::infinity(),
                                   Limits::max(),
                                   Limits::denorm_min(),
                                   0.0,
                                   -0.0,
                                   1.0,
                                   -1.0,
                                   999.0,
                                   1e6,
                                   1e7,
                                   1e4,
                                   1e-9,
                                   5e5,
                                   24'999.0};
  const Piece piece = piece_of_numbers(bytes, random);
  put(bytes, double_in(bytes, piece, random), kDoubles[below(kDoubles.size(), random)]);
}

void change_a_header(Bytes& bytes, Pcg32& random) {
  const Piece piece = any_piece(bytes, random);
  constexpr std::array<std::uint32_t, 6> kLengths = {0, 1, 7, 1'000, 0x7FFFFFFF, 0xFFFFFFFF};
  switch (below(4, random)) {
    case 0:
      bytes[piece.begin + below(4, random)] = static_cast<std::uint8_t>(random.next());
      break;
    case 1:
      put(bytes, piece.begin + 4, static_cast<std::uint16_t>(random.next()));
      break;
    case 2:
      put(bytes, piece.begin + 6, kLengths[below(kLengths.size(), random)]);
      break;
    default:
      put(bytes, piece.begin, kSections[below(kSections.size(), random)].tag);
      break;
  }
}

void insert(Bytes& bytes, std::size_t at, const Bytes& what) {
  bytes.insert(bytes.begin() + static_cast<std::ptrdiff_t>(at), what.begin(), what.end());
}

Bytes copy_of(const Bytes& bytes, Piece piece) {
  return {bytes.begin() + static_cast<std::ptrdiff_t>(piece.begin), bytes.begin() + static_cast<std::ptrdiff_t>(piece.end)};
}

void erase(Bytes& bytes, Piece piece) {
  bytes.erase(bytes.begin() + static_cast<std::ptrdiff_t>(piece.begin), bytes.begin() + static_cast<std::ptrdiff_t>(piece.end));
}

void drop_a_section(Bytes& bytes, Pcg32& random) {
  erase(bytes, any_piece(bytes, random));
}

void double_a_section(Bytes& bytes, Pcg32& random) {
  const Bytes copy = copy_of(bytes, any_piece(bytes, random));
  insert(bytes, any_piece(bytes, random).begin, copy);
}

void move_a_section(Bytes& bytes, Pcg32& random) {
  const Piece piece = any_piece(bytes, random);
  const Bytes copy = copy_of(bytes, piece);
  erase(bytes, piece);
  insert(bytes, any_piece(bytes, random).begin, copy);
}

/// Takes some bytes out of a section, or puts some in; its length says so or does not.
void resize_a_section(Bytes& bytes, Pcg32& random) {
  const Piece piece = any_piece(bytes, random);
  const std::size_t at = piece.begin + below(piece.end - piece.begin, random);
  const std::size_t count = 1 + below(40, random);
  std::size_t length = piece.end - piece.begin - kSectionHeaderSize;
  if ((random.next() & 1U) != 0U) {
    insert(bytes, at, Bytes(count, static_cast<std::uint8_t>(random.next())));
    length += count;
  } else {
    const std::size_t end = std::min(at + count, piece.end);
    erase(bytes, {at, end});
    length -= std::min(length, end - at);
  }
  if ((random.next() & 1U) != 0U) put(bytes, piece.begin + 6, static_cast<std::uint32_t>(length));
}

void mend(Bytes& bytes, Pcg32& random) {
  const bool lies = random.next() % 64 == 0;
  put(bytes, kLengthAt, lies ? random.next() : static_cast<std::uint32_t>(bytes.size()));
  const std::size_t covered = bytes.size() - policy::kSignatureSize - kChecksumSize;
  put(bytes, covered, crc32(std::span(bytes).first(covered)));
}

}  // namespace

Bytes mutated(const Bytes& good, Pcg32& random) {
  using Mutation = void (*)(Bytes&, Pcg32&);
  constexpr std::array<Mutation, 6> kShapes = {change_a_header, drop_a_section,   double_a_section,
                                               move_a_section,  resize_a_section, change_bytes};
  constexpr std::array<Mutation, 6> kNumbers = {flip_a_bit, flip_a_bit, put_a_float, put_a_float, put_a_float, put_a_double};
  Bytes bytes = good;
  // What is of another shape is refused early: most keep theirs, so that many fly.
  const bool keeps_shape = random.next() % 4 != 0;
  for (std::size_t changes = 1 + below(3, random); changes > 0; --changes)
    (keeps_shape ? kNumbers[below(kNumbers.size(), random)] : kShapes[below(kShapes.size(), random)])(bytes, random);
  mend(bytes, random);
  return bytes;
}

}  // namespace earshot::fuzz
