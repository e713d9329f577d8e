#include "firmware/host/journal/journal_name.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstring>
#include <fstream>
#include <span>
#include <string>
#include <string_view>
#include <system_error>

#include "firmware/core/big_endian.hpp"
#include "firmware/host/journal/journal_format.hpp"

namespace earshot::host {
namespace {

constexpr std::string_view kPart = ".part";

/// Takes a whole number from 2 to `most` off the beginning. @return nothing: none stands there as it is written
std::optional<int> take_number(std::string_view& text, int most) {
  int number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || number < 2 || number > most || text.starts_with('0')) return std::nullopt;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return number;
}

bool take(std::string_view& text, std::string_view beginning) {
  if (!text.starts_with(beginning)) return false;
  text.remove_prefix(beginning.size());
  return true;
}

}  // namespace

std::filesystem::path named(const std::filesystem::path& wanted, JournalName name) {
  std::string file = wanted.stem().string();
  if (name.journal > 1) file += "-" + std::to_string(name.journal);
  if (name.part > 1) file += std::string(kPart) + std::to_string(name.part);
  return wanted.parent_path() / (file + wanted.extension().string());
}

std::optional<JournalName> name_of(const std::filesystem::path& wanted, const std::filesystem::path& file) {
  const std::string text = file.filename().string();
  const std::string stem = wanted.stem().string();
  std::string_view rest = text;
  JournalName name;
  if (!take(rest, stem)) return std::nullopt;
  if (take(rest, "-")) {
    const std::optional<int> number = take_number(rest, kMostJournals);
    if (!number) return std::nullopt;
    name.journal = *number;
  }
  if (take(rest, kPart)) {
    const std::optional<int> number = take_number(rest, kMostParts);
    if (!number) return std::nullopt;
    name.part = *number;
  }
  return rest == wanted.extension().string() ? std::optional(name) : std::nullopt;
}

std::filesystem::path part_of(const std::filesystem::path& first, int part) {
  return named(first, {.journal = 1, .part = part});
}

std::optional<std::filesystem::path> first_part_of(const std::filesystem::path& file) {
  const std::string stem = file.stem().string();
  const std::size_t at = stem.rfind(kPart);
  if (at == std::string::npos || at == 0) return std::nullopt;
  std::string_view number = std::string_view(stem).substr(at + kPart.size());
  if (!take_number(number, kMostParts) || !number.empty()) return std::nullopt;
  return file.parent_path() / (stem.substr(0, at) + file.extension().string());
}

std::vector<JournalName> journals_beside(const std::filesystem::path& wanted) {
  std::vector<JournalName> names;
  std::error_code error;
  const std::filesystem::path folder = wanted.has_parent_path() ? wanted.parent_path() : ".";
  for (std::filesystem::directory_iterator file(folder, error), end; !error && file != end; file.increment(error)) {
    if (const std::optional<JournalName> name = name_of(wanted, file->path())) names.push_back(*name);
  }
  return names;
}

std::optional<std::filesystem::path> newest_journal(const std::filesystem::path& wanted) {
  int newest = 0;
  for (const JournalName& name : journals_beside(wanted)) newest = name.part == 1 ? std::max(newest, name.journal) : newest;
  return newest > 0 ? std::optional(named(wanted, {.journal = newest})) : std::nullopt;
}

std::filesystem::path newest_journal_in(const std::filesystem::path& folder_or_journal) {
  std::error_code error;
  if (!std::filesystem::is_directory(folder_or_journal, error)) return folder_or_journal;
  const std::filesystem::path first = folder_or_journal / kFirstJournal;
  return newest_journal(first).value_or(first);
}

std::optional<std::filesystem::path> journal_marked(const std::filesystem::path& wanted, std::uint32_t first_record_crc32) {
  std::array<std::uint8_t, kCheckedFrom> mark{};
  store_big_endian(std::span(mark).first(4), kRecordSync);
  store_big_endian(std::span(mark).subspan(4), first_record_crc32);
  int newest = 0;
  for (const JournalName& name : journals_beside(wanted)) {
    if (name.part > 1 || name.journal < newest) continue;
    std::array<char, kCheckedFrom> beginning{};
    std::error_code error;
    if (!std::filesystem::is_regular_file(named(wanted, name), error)) continue;  // of a pipe the reading would never end
    std::ifstream file(named(wanted, name), std::ios::binary);
    if (file.read(beginning.data(), beginning.size()) && std::memcmp(beginning.data(), mark.data(), mark.size()) == 0)
      newest = name.journal;
  }
  return newest > 0 ? std::optional(named(wanted, {.journal = newest})) : std::nullopt;
}

}  // namespace earshot::host
