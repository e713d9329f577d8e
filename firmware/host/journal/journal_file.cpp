#include "firmware/host/journal/journal_file.hpp"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <string>
#include <system_error>

#include "firmware/host/file/folder_lock.hpp"

namespace earshot::host {
namespace {

constexpr int kMostJournals = 9999;  ///< in one folder

[[noreturn]] void fail(const std::filesystem::path& path) {
  throw std::system_error(errno, std::generic_category(), path.string());
}

/// "journal-2.lcmlog" for "journal.lcmlog"
std::filesystem::path numbered(const std::filesystem::path& path, int number) {
  std::filesystem::path name = path.stem();
  name += "-" + std::to_string(number);
  name += path.extension();
  return path.parent_path() / name;
}

}  // namespace

std::optional<std::filesystem::path> newest_journal(const std::filesystem::path& wanted) {
  std::optional<std::filesystem::path> newest;
  std::error_code error;
  std::filesystem::path path = wanted;
  for (int number = 2; std::filesystem::exists(path, error); path = numbered(wanted, number++)) newest = path;
  return newest;
}

JournalFile::JournalFile(const std::filesystem::path& wanted, ExistingJournal existing) : path_(wanted) {
  // What is replaced is emptied only when nobody writes it.
  const int mode = existing == ExistingJournal::kGoOn ? 0 : (existing == ExistingJournal::kReplace ? O_CREAT : O_CREAT | O_EXCL);
  for (int number = 2;; ++number) {
    file_ = FileDescriptor(::open(path_.c_str(), O_WRONLY | O_CLOEXEC | mode, 0644));
    if (file_.number() >= 0) break;
    if (errno != EEXIST || existing != ExistingJournal::kKeep || number > kMostJournals) fail(path_);
    path_ = numbered(wanted, number);
  }
  struct stat status {};
  if (::fstat(file_.number(), &status) != 0) fail(path_);
  if (!S_ISREG(status.st_mode)) return;
  mark_as_written(file_, path_);
  cut(existing == ExistingJournal::kGoOn ? static_cast<std::uint64_t>(status.st_size) : 0);
}

void JournalFile::cut(std::uint64_t size) {
  const auto end = static_cast<off_t>(size);
  if (::ftruncate(file_.number(), end) != 0 || ::lseek(file_.number(), end, SEEK_SET) != end) fail(path_);
  size_ = held_ = size;
}

void JournalFile::keep_entry() const {
  const std::filesystem::path folder = path_.has_parent_path() ? path_.parent_path() : ".";
  const FileDescriptor entries(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (entries.number() < 0 || ::fsync(entries.number()) != 0) fail(folder);
}

std::size_t JournalFile::write_some(std::span<const std::uint8_t> bytes, std::uint64_t kept) {
  if (kept > 0) {
    while (can_hold_ && room(size_, kept) < bytes.size() && hold_more()) {
    }
    if (can_hold_) bytes = bytes.first(std::min<std::size_t>(bytes.size(), room(size_, kept)));
  }
  if (bytes.empty()) return 0;
  const ssize_t count = ::write(file_.number(), bytes.data(), bytes.size());
  if (count <= 0) return 0;
  size_ += static_cast<std::uint64_t>(count);
  held_ = std::max(held_, size_);
  return static_cast<std::size_t>(count);
}

bool JournalFile::hold_more() {
  // Not every file system looks at the limit while the file itself does not grow.
  rlimit limit{};
  if (::getrlimit(RLIMIT_FSIZE, &limit) == 0 && held_ + kJournalReserveBytes > limit.rlim_cur) return false;
  if (::fallocate(file_.number(), FALLOC_FL_KEEP_SIZE, static_cast<off_t>(held_), static_cast<off_t>(kJournalReserveBytes)) == 0) {
    held_ += kJournalReserveBytes;
    return true;
  }
  can_hold_ = errno == ENOSPC || errno == EDQUOT || errno == EFBIG || errno == EINTR;
  return false;
}

bool JournalFile::go_back(std::uint64_t size) {
  if (size == size_) return true;
  const auto offset = static_cast<off_t>(size);
  if (::lseek(file_.number(), offset, SEEK_SET) != offset) return false;
  size_ = size;
  return true;
}

bool JournalFile::bring_to_disk() {
  return ::fdatasync(file_.number()) == 0;
}

bool JournalFile::close() {
  const bool is_cut = held_ == size_ || ::ftruncate(file_.number(), static_cast<off_t>(size_)) == 0;
  file_ = FileDescriptor();
  return is_cut;
}

}  // namespace earshot::host
