#include "firmware/host/journal/journal_parts.hpp"

#include <algorithm>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include "firmware/core/crc32.hpp"
#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/journal/journal_format.hpp"
#include "firmware/wire/lcm/channels.hpp"
#include "firmware/wire/lcm/encoding.hpp"

namespace earshot::host {
namespace {

constexpr std::size_t kMostOfFirstRecord_bytes = std::size_t{1} << 20U;

/// The record that a file begins with. Empty: none does.
std::vector<std::uint8_t> first_record(InputFile& file) {
  std::vector<std::uint8_t> bytes(kRecordHeaderSize);
  if (file.read(bytes) < bytes.size() || load_big_endian(std::span(bytes).first(4)) != kRecordSync) return {};
  const std::uint64_t more = load_big_endian(std::span(bytes).subspan(20, 4)) + load_big_endian(std::span(bytes).subspan(24, 4));
  if (more > kMostOfFirstRecord_bytes) return {};
  bytes.resize(kRecordHeaderSize + static_cast<std::size_t>(more));
  const std::size_t count = file.read(std::span(bytes).subspan(kRecordHeaderSize));
  const bool is_whole = count == more && load_big_endian(std::span(bytes).subspan(4, 4)) == crc32(std::span(bytes).subspan(kCheckedFrom));
  return is_whole ? bytes : std::vector<std::uint8_t>();
}

/// What the first record of a later part says. Nothing: it is no such record.
std::optional<messages::JournalPart> beginning_of_part(std::span<const std::uint8_t> record) {
  if (record.empty()) return std::nullopt;
  const auto channel_size = static_cast<std::size_t>(load_big_endian(record.subspan(20, 4)));
  const std::string_view channel(reinterpret_cast<const char*>(record.data()) + kRecordHeaderSize, channel_size);
  messages::JournalPart beginning;
  if (channel != wire::kJournalPartChannel || wire::decode(record.subspan(kRecordHeaderSize + channel_size), beginning) != Status::kOk)
    return std::nullopt;
  return beginning;
}

/// The other parts stand beside the file that a link leads to.
std::filesystem::path linked_file(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::is_symlink(path, error)) return path;
  std::filesystem::path file = std::filesystem::canonical(path, error);
  return error ? path : file;
}

}  // namespace

JournalParts::JournalParts(const std::filesystem::path& first) : first_(linked_file(first)), file_(first, kAnySize) {
  if (const std::vector<std::uint8_t> record = first_record(file_); !record.empty())
    id_ = static_cast<std::uint32_t>(load_big_endian(std::span(record).subspan(4, 4)));
  file_.go_to(0);
  size_ = file_.size();
  while (const std::optional<Opened> part = next_part()) {
    parts_.push_back({.number = part->number, .begin = size_});
    size_ += part->file.size();
  }
  if (const std::optional<std::filesystem::path> journal = first_part_of(first)) refuse_part_of(*journal);
}

/// Read alone, what stands in the parts before it would seem to be lost.
void JournalParts::refuse_part_of(const std::filesystem::path& journal) const {
  std::error_code error;
  if (!std::filesystem::is_regular_file(journal, error)) return;
  const JournalParts whole(journal);
  for (std::size_t i = 1; i < whole.parts_.size(); ++i) {
    if (whole.path_of(i) == first_)
      throw BadInput(first_.string() + ": is part " + std::to_string(whole.parts_[i].number) + " of the journal " + journal.string() +
                     "; name that, and all of its parts are read");
  }
}

std::optional<JournalParts::Opened> JournalParts::next_part() const {
  const int last = parts_.back().number;
  if (std::optional<InputFile> file = open(last + 1)) return Opened{.number = last + 1, .file = *std::move(file)};
  std::vector<int> later;
  for (const JournalName& name : journals_beside(first_)) {
    if (name.journal == 1 && name.part > last + 1) later.push_back(name.part);
  }
  std::ranges::sort(later);
  for (const int number : later) {
    if (std::optional<InputFile> file = open(number)) return Opened{.number = number, .file = *std::move(file)};
  }
  return std::nullopt;
}

std::optional<InputFile> JournalParts::open(int number) const {
  const std::filesystem::path path = part_of(first_, number);
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return std::nullopt;
  try {
    InputFile file(path, kAnySize);
    if (file.size() == 0 || !belongs(file, number)) return std::nullopt;
    file.go_to(0);
    return file;
  } catch (const BadInput&) {
    return std::nullopt;  // it went, or may not be read: the journal ends before it
  }
}

bool JournalParts::belongs(InputFile& file, int number) const {
  const std::vector<std::uint8_t> record = first_record(file);
  if (record.empty()) return true;
  const std::optional<messages::JournalPart> beginning = beginning_of_part(record);
  return beginning && beginning->part == static_cast<std::uint32_t>(number) && (!id_ || beginning->first_record_crc32 == *id_);
}

std::optional<std::filesystem::path> JournalParts::misplaced() const {
  for (const JournalName& name : journals_beside(first_)) {
    const std::filesystem::path path = part_of(first_, name.part);
    std::error_code error;
    if (name.journal != 1 || name.part == 1 || !id_ || !std::filesystem::is_regular_file(path, error)) continue;
    try {
      InputFile file(path, kAnySize);
      const std::optional<messages::JournalPart> beginning = beginning_of_part(first_record(file));
      if (beginning && beginning->part != static_cast<std::uint32_t>(name.part) && beginning->first_record_crc32 == *id_) return path;
    } catch (const BadInput&) {
      continue;  // what cannot be read is none of its parts
    }
  }
  return std::nullopt;
}

std::size_t JournalParts::read(std::span<std::uint8_t> into) {
  std::size_t filled = 0;
  const auto read_on = [&] {
    const std::size_t count = file_.read(into.subspan(filled));
    filled += count;
    position_ += count;
    return filled == into.size();
  };
  for (;;) {
    if (read_on()) return filled;
    if (current_ + 1 < parts_.size()) {
      file_ = InputFile(path_of(current_ + 1), kAnySize);
    } else {
      std::optional<Opened> next = next_part();
      if (!next || read_on()) return filled;  // what was written before the next part was begun
      parts_.push_back({.number = next->number, .begin = parts_[current_].begin + position_});
      file_ = std::move(next->file);
    }
    position_ = 0;
    ++current_;
  }
}

std::size_t JournalParts::index_of(std::uint64_t offset) const {
  const auto behind =
      std::lower_bound(parts_.begin() + 1, parts_.end(), offset, [](const Part& part, std::uint64_t at) { return part.begin < at; });
  return static_cast<std::size_t>(behind - parts_.begin()) - 1;
}

void JournalParts::go_to(std::uint64_t offset) {
  const std::size_t index = index_of(offset);
  if (index != current_) file_ = InputFile(path_of(index), kAnySize);
  current_ = index;
  position_ = offset - parts_[index].begin;
  file_.go_to(position_);
}

int JournalParts::missing_before(std::uint64_t offset) const {
  const std::size_t index = index_of(offset);
  return index == 0 ? 0 : parts_[index].number - parts_[index - 1].number - 1;
}

JournalParts::Place JournalParts::place_of(std::uint64_t offset) const {
  const std::size_t index = index_of(offset);
  return {.part = parts_[index].number, .file = path_of(index), .offset = offset - parts_[index].begin};
}

std::vector<std::filesystem::path> JournalParts::files() const {
  std::vector<std::filesystem::path> files;
  for (std::size_t i = 0; i < parts_.size(); ++i) files.push_back(path_of(i));
  return files;
}

}  // namespace earshot::host
