#include "sim/recording/sound_texts.hpp"

#include <algorithm>
#include <cstddef>
#include <string_view>

namespace earshot::recording {
namespace {

/// Texts have some hundred bytes, a table of a HARP's 65 535 raw files 2 MB.
constexpr std::uint64_t kMost_bytes = std::uint64_t{4} << 20U;
/// EBU Tech 3285: description, originator and its reference stand before.
constexpr std::size_t kOriginationDate = 256 + 32 + 32;
constexpr std::size_t kDate_bytes = 10;
constexpr std::size_t kTime_bytes = 8;

std::string_view up_to_zero(std::string_view text) {
  return text.substr(0, text.find('\0'));
}

void take_info(std::string_view list, SoundTexts& texts) {
  if (!list.starts_with("INFO")) return;
  list.remove_prefix(4);
  while (list.size() > 8) {
    const std::string_view name = list.substr(0, 4);
    std::size_t size = 0;
    for (std::size_t i = 4; i > 0; --i) size = size << 8U | static_cast<unsigned char>(list[3 + i]);
    const std::string_view text = up_to_zero(list.substr(8, size));
    if (name == "IART") texts.artist = text;
    if (name == "IPRD") texts.album = text;
    if (name == "ICMT") texts.comment = text;
    if (name == "ICRD") texts.date = text;
    if (name == "ISFT") texts.software = text;
    list.remove_prefix(std::min(list.size(), 8 + size + size % 2));
  }
}

std::string origin_of(std::string_view bext) {
  if (bext.size() < kOriginationDate + kDate_bytes + kTime_bytes) return {};
  std::string date(bext.substr(kOriginationDate, kDate_bytes));
  std::string time(bext.substr(kOriginationDate + kDate_bytes, kTime_bytes));
  if (date.find('\0') != std::string::npos || time.find('\0') != std::string::npos) return {};
  // The standard lets - _ : . and blank part the numbers.
  for (const std::size_t at : {4U, 7U}) date[at] = '-';
  for (const std::size_t at : {2U, 5U}) time[at] = ':';
  return date + ' ' + time;
}

}  // namespace

SoundTexts texts_of(const std::filesystem::path& path, const RiffFile& riff) {
  SoundTexts texts;
  for (const RiffChunk& chunk : riff.chunks) {
    const bool is_wanted = chunk.name == "LIST" || chunk.name == "guan" || chunk.name == "bext" || chunk.name == "harp";
    if (!is_wanted) continue;
    const std::string content = content_of(path, chunk, kMost_bytes);
    if (chunk.name == "LIST") take_info(content, texts);
    if (chunk.name == "guan") texts.guano = content;
    if (chunk.name == "bext") texts.origin = origin_of(content);
    if (chunk.name == "harp") texts.harp = content;
  }
  return texts;
}

}  // namespace earshot::recording
