#include "firmware/wire/n2k/text.hpp"

#include <algorithm>

namespace earshot::n2k {

namespace {

constexpr std::size_t kHeaderBytes = 2;
constexpr std::uint8_t kSingleByteCharacters = 1;
constexpr std::size_t kLongest = 255 - kHeaderBytes;

bool is_printable(std::string_view text) {
  return std::ranges::all_of(text, [](char c) { return c >= ' ' && c <= '~'; });
}

std::string_view characters(std::span<const std::uint8_t> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};  // NOLINT: characters are bytes
}

/// What stands before the first byte that no text has.
std::string_view before_padding(std::string_view text) {
  return {text.begin(), std::ranges::find_if(text, [](char c) { return c == '\0' || c == '\xFF'; })};
}

}  // namespace

Result<std::string_view> fixed_text(const Signal& signal, std::span<const std::uint8_t> bytes) {
  const std::size_t first = signal.first_bit / 8U;
  const std::size_t size = signal.bit_count / 8U;
  if (signal.kind != Signal::Kind::kFixedText || first + size > bytes.size()) return Status::kMalformed;
  std::string_view text = characters(bytes.subspan(first, size));
  text = before_padding(text);
  while (!text.empty() && (text.back() == ' ' || text.back() == '@')) text.remove_suffix(1);
  if (text.empty()) return Status::kNotReady;
  return text;
}

Status write_fixed_text(const Signal& signal, std::string_view text, std::span<std::uint8_t> bytes) {
  const std::size_t first = signal.first_bit / 8U;
  const std::size_t size = signal.bit_count / 8U;
  if (signal.kind != Signal::Kind::kFixedText || first + size > bytes.size()) return Status::kFull;
  if (text.size() > size || !is_printable(text)) return Status::kOutOfRange;
  const auto field = bytes.subspan(first, size);
  std::fill(std::ranges::copy(text, field.begin()).out, field.end(), std::uint8_t{0xFF});
  return Status::kOk;
}

Result<std::string_view> take_variable_text(std::span<const std::uint8_t>& bytes) {
  if (bytes.empty() || bytes[0] < kHeaderBytes || bytes[0] > bytes.size()) return Status::kMalformed;
  const std::uint8_t encoding = bytes[1];
  std::string_view text = characters(bytes.subspan(kHeaderBytes, bytes[0] - kHeaderBytes));
  bytes = bytes.subspan(bytes[0]);
  text = before_padding(text);
  if (text.empty()) return Status::kNotReady;
  if (encoding != kSingleByteCharacters) return Status::kUnsupported;
  return text;
}

Status put_variable_text(std::string_view text, std::span<std::uint8_t>& bytes) {
  if (text.size() > kLongest || !is_printable(text)) return Status::kOutOfRange;
  if (bytes.size() < kHeaderBytes + text.size()) return Status::kFull;
  bytes[0] = static_cast<std::uint8_t>(kHeaderBytes + text.size());
  bytes[1] = kSingleByteCharacters;
  std::ranges::copy(text, bytes.begin() + kHeaderBytes);
  bytes = bytes.subspan(kHeaderBytes + text.size());
  return Status::kOk;
}

}  // namespace earshot::n2k
