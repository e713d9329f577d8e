#include "firmware/host/journal/old_journals.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <iterator>
#include <optional>
#include <utility>

#include "firmware/host/file/file_descriptor.hpp"
#include "firmware/host/journal/journal_format.hpp"
#include "firmware/host/journal/journal_name.hpp"

namespace earshot::host {
namespace {

constexpr std::string_view kPolicyMagic = "EARSHOTP";
constexpr std::string_view kTablesMagic = "EARSHOTT";
static_assert(kTablesMagic.size() == kPolicyMagic.size());
constexpr std::string_view kNeverWritten("\0\0\0\0", 4);

/// Its size; nothing: it is no regular file, or begins with something else. An empty file is of every kind.
std::optional<std::uint64_t> size_of(const std::filesystem::path& path, std::string_view magic) {
  struct stat status {};
  if (::lstat(path.c_str(), &status) != 0 || !S_ISREG(status.st_mode)) return std::nullopt;
  const FileDescriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK));
  std::array<char, kPolicyMagic.size()> beginning{};
  if (file.number() < 0) return std::nullopt;
  const bool is_of_kind = status.st_size == 0 || (::read(file.number(), beginning.data(), magic.size()) == std::ssize(magic) &&
                                                  std::string_view(beginning.data(), magic.size()) == magic);
  return is_of_kind ? std::optional(static_cast<std::uint64_t>(status.st_size)) : std::nullopt;
}

}  // namespace

OldJournals::OldJournals(const std::filesystem::path& wanted, int own) {
  std::vector<JournalName> names = journals_beside(wanted);
  std::ranges::sort(names, {}, [](const JournalName& name) { return std::pair(name.journal, name.part); });
  for (const JournalName& name : names) {
    if (name.journal == own) continue;
    const std::filesystem::path path = named(wanted, name);
    const std::optional<std::uint64_t> size = size_of(path, kRecordSyncBytes);
    if (!size) continue;
    if (journals_.empty() || journals_.back().number != name.journal) journals_.push_back({.number = name.journal});
    journals_.back().files.push_back({.path = path, .bytes = *size, .magic = kRecordSyncBytes});
    bytes_ += *size;
  }
  for (Old& old : journals_) {
    std::filesystem::path beside = named(wanted, {.journal = old.number});
    old.files.push_back({.path = beside.replace_extension(".policy"), .bytes = 0, .magic = kPolicyMagic});
    old.files.push_back({.path = beside.replace_extension(".tables"), .bytes = 0, .magic = kTablesMagic});
  }
}

bool OldJournals::is_written(const Old& old) {
  const FileDescriptor file(::open(old.files.front().path.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK));
  if (file.number() < 0) return errno != ENOENT && errno != ELOOP;  // who cannot look does not delete
  return ::flock(file.number(), LOCK_EX | LOCK_NB) != 0;
}

bool OldJournals::delete_oldest() {
  while (next_ < journals_.size()) {
    const Old& old = journals_[next_++];
    if (!is_written(old) && remove(old)) return true;
  }
  return false;
}

bool OldJournals::remove(const Old& old) {
  std::uint64_t freed = 0;
  bool is_deleted = false;
  // The last part first: whoever stops in between leaves a journal that reads up to there.
  for (auto file = old.files.rbegin(); file != old.files.rend(); ++file) {
    if (size_of(file->path, file->magic)) {
      if (::unlink(file->path.c_str()) != 0) break;
      is_deleted = is_deleted || file->magic == kRecordSyncBytes;
    }
    freed += file->bytes;
  }
  bytes_ -= freed;
  if (is_deleted) {
    ++deleted_;
    last_deleted_ = old.number;
  }
  return freed > 0;
}

void delete_later_parts(const std::filesystem::path& first) {
  std::vector<JournalName> names = journals_beside(first);
  std::ranges::sort(names, {}, &JournalName::part);
  std::vector<std::filesystem::path> parts;
  for (const JournalName& name : names) {
    const std::filesystem::path part = part_of(first, name.part);
    if (name.journal == 1 && name.part > 1 && size_of(part, kRecordSyncBytes)) parts.push_back(part);
  }
  delete_parts(parts);
}

void delete_parts(std::span<const std::filesystem::path> parts) {
  for (auto part = parts.rbegin(); part != parts.rend(); ++part) {  // whoever stops in between leaves no gap
    if (size_of(*part, kRecordSyncBytes) || size_of(*part, kNeverWritten)) (void)::unlink(part->c_str());
  }
}

}  // namespace earshot::host
