#include "firmware/host/journal/old_journals.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "firmware/host/file/file_descriptor.hpp"
#include "firmware/host/journal/journal_format.hpp"
#include "firmware/host/journal/journal_name.hpp"

namespace earshot::host {
namespace {

/// Its size; nothing: it is no regular file, or begins with something else. An empty journal is one.
std::optional<std::uint64_t> size_of_journal(const std::filesystem::path& path) {
  struct stat status {};
  if (::lstat(path.c_str(), &status) != 0 || !S_ISREG(status.st_mode)) return std::nullopt;
  const FileDescriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK));
  std::array<std::uint8_t, 4> beginning{};
  if (file.number() < 0) return std::nullopt;
  const bool is_journal =
      status.st_size == 0 || (::read(file.number(), beginning.data(), beginning.size()) == 4 && load(beginning) == kRecordSync);
  return is_journal ? std::optional(static_cast<std::uint64_t>(status.st_size)) : std::nullopt;
}

bool is_regular(const std::filesystem::path& path) {
  struct stat status {};
  return ::lstat(path.c_str(), &status) == 0 && S_ISREG(status.st_mode);
}

}  // namespace

OldJournals::OldJournals(const std::filesystem::path& wanted, int own) {
  std::vector<JournalName> names = journals_beside(wanted);
  std::ranges::sort(names, {}, [](const JournalName& name) { return std::pair(name.journal, name.part); });
  for (const JournalName& name : names) {
    if (name.journal == own) continue;
    const std::filesystem::path path = named(wanted, name);
    const std::optional<std::uint64_t> size = size_of_journal(path);
    if (!size) continue;
    if (journals_.empty() || journals_.back().number != name.journal) journals_.push_back({.number = name.journal});
    journals_.back().bytes += *size;
    journals_.back().files.push_back(path);
    bytes_ += *size;
  }
  for (Old& old : journals_) {
    const std::filesystem::path policy = named(wanted, {.journal = old.number}).replace_extension(".policy");
    if (is_regular(policy)) old.files.push_back(policy);
  }
}

bool OldJournals::is_written(const Old& old) {
  const FileDescriptor file(::open(old.files.front().c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK));
  return file.number() >= 0 && ::flock(file.number(), LOCK_EX | LOCK_NB) != 0;
}

bool OldJournals::delete_oldest() {
  for (; next_ < journals_.size(); ++next_) {
    const Old& old = journals_[next_];
    if (is_written(old)) continue;
    // The last part first: whoever stops in between leaves a journal that reads up to there.
    bool is_gone = true;
    for (auto file = old.files.rbegin(); file != old.files.rend(); ++file) is_gone = ::unlink(file->c_str()) == 0 && is_gone;
    if (!is_gone) continue;
    bytes_ -= old.bytes;
    ++deleted_;
    ++next_;
    return true;
  }
  return false;
}

void delete_later_parts(const std::filesystem::path& first, int last) {
  for (const JournalName& name : journals_beside(first)) {
    if (name.journal != 1 || name.part <= last) continue;
    const std::filesystem::path part = part_of(first, name.part);
    if (size_of_journal(part)) (void)::unlink(part.c_str());
  }
}

}  // namespace earshot::host
