#include "firmware/host/safety_record/record_file.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <utility>

#include "firmware/core/big_endian.hpp"
#include "firmware/core/crc32.hpp"

namespace earshot::host {
namespace {

constexpr mode_t kMode = 0640;
constexpr std::size_t kKeptAt = kRecordSlots * kRecordSlotBytes;
using Slot = std::array<std::uint8_t, kRecordSlotBytes>;

bool write_all(int file, std::span<const std::uint8_t> bytes, std::size_t at) {
  while (!bytes.empty()) {
    const ssize_t done = ::pwrite(file, bytes.data(), bytes.size(), static_cast<off_t>(at));
    if (done < 0 && errno == EINTR) continue;
    if (done <= 0) return false;
    bytes = bytes.subspan(static_cast<std::size_t>(done));
    at += static_cast<std::size_t>(done);
  }
  return true;
}

/// @return how many bytes are there
std::size_t read_all(int file, std::span<std::uint8_t> into, std::size_t at) {
  std::size_t got = 0;
  while (got < into.size()) {
    const ssize_t done = ::pread(file, into.data() + got, into.size() - got, static_cast<off_t>(at + got));
    if (done < 0 && errno == EINTR) continue;
    if (done <= 0) break;
    got += static_cast<std::size_t>(done);
  }
  return got;
}

/// A slot fills its block: a disk writes whole blocks, and none of the other's.
Slot slot_of(const SafetyRecord& record) {
  Slot slot{};
  std::ranges::copy(encoded(record), slot.begin());
  return slot;
}

bool is_ours(const struct stat& status) {
  struct stat root {};  // who owns it is root, in a container, too
  const bool is_roots = status.st_uid == 0 || (::stat("/", &root) == 0 && status.st_uid == root.st_uid);
  return (is_roots || status.st_uid == ::geteuid()) && (status.st_mode & (S_IWGRP | S_IWOTH)) == 0;
}

}  // namespace

RecordFile::RecordFile(std::filesystem::path path)
    : path_(std::move(path)), folder_(path_.has_parent_path() ? path_.parent_path() : std::filesystem::path(".")) {}

FileDescriptor RecordFile::opened_to(int access) {
  // Never through a link, which may lead anywhere, nor into a pipe, which may wait.
  FileDescriptor file(::open(path_.c_str(), access | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK));
  out_of_reach_ = file.number() < 0 && (errno == EMFILE || errno == ENFILE || errno == ENOMEM) ? errno : 0;
  is_unreadable_ = file.number() >= 0 || (errno != ENOENT && errno != ENOTDIR);
  struct stat status {};
  if (file.number() < 0 || ::fstat(file.number(), &status) != 0 || !S_ISREG(status.st_mode)) return FileDescriptor();
  is_anybodys_ = !is_ours(status);
  if (is_anybodys_) {
    if (const std::optional<Found> found = newest_slot(file.number())) unbelieved_ = found->record;
    return FileDescriptor();
  }
  is_unreadable_ = false;
  return file;
}

bool RecordFile::open() {
  FileDescriptor file = opened_to(O_RDWR);
  const bool is_writable = file.number() >= 0;
  if (!is_writable && !is_anybodys_) file = opened_to(O_RDONLY);
  if (file.number() < 0) return false;
  let_go();
  file_ = std::move(file);
  is_writable_ = is_writable;
  return true;
}

/// A disk that was read-only when the file was opened may be so no longer, but not by that descriptor: then the file is opened anew.
/// Between the two claims another process may have made its own: then the file is that one's.
bool RecordFile::is_to_be_written() {
  if (file_.number() < 0 || is_writable_) return file_.number() >= 0;
  FileDescriptor file = opened_to(O_RDWR);
  if (file.number() < 0) return false;
  const bool was_claimed = is_claimed_;
  let_go();
  file_ = std::move(file);
  is_writable_ = true;
  if (was_claimed && !claim()) let_go();
  return file_.number() >= 0;
}

void RecordFile::let_go() {
  file_ = FileDescriptor();
  is_writable_ = false;
  is_claimed_ = false;
}

bool RecordFile::claim() {
  if (file_.number() < 0) return true;
  is_claimed_ = ::flock(file_.number(), LOCK_EX | LOCK_NB) == 0;
  return is_claimed_ || errno != EWOULDBLOCK;
}

MarkedBy RecordFile::marked_by() const {
  return host::marked_by(file_);
}

std::string RecordFile::holder() const {
  try {
    require_not_being_written(path_);
  } catch (const FolderInUse& e) {
    return e.what();
  }
  return path_.string() + ": another program is writing this file";
}

std::optional<RecordFile::Found> RecordFile::newest_slot(int file) {
  std::optional<Found> newest;
  for (std::size_t slot = 0; file >= 0 && slot < kRecordSlots; ++slot) {
    SafetyRecordBytes bytes{};
    const std::size_t size = read_all(file, bytes, slot * kRecordSlotBytes);
    const std::optional<SafetyRecord> record = read_safety_record(std::span(bytes).first(size));
    if (record && (!newest || record->sequence >= newest->record.sequence)) newest = Found{.record = *record, .slot = slot};
  }
  return newest;
}

std::optional<SafetyRecord> RecordFile::newest() const {
  const std::optional<Found> found = newest_slot(file_.number());
  return found ? std::optional(found->record) : std::nullopt;
}

std::vector<std::uint8_t> RecordFile::kept(std::uint32_t crc32) const {
  std::array<std::uint8_t, 4> size{};
  if (file_.number() < 0 || read_all(file_.number(), size, kKeptAt) < size.size()) return {};
  std::vector<std::uint8_t> bytes(std::min<std::uint64_t>(load_big_endian(size), kMostKeptBytes - size.size()));
  if (read_all(file_.number(), bytes, kKeptAt + size.size()) < bytes.size() || earshot::crc32(bytes) != crc32) return {};
  return bytes;
}

bool RecordFile::holds(std::span<const std::uint8_t> kept) const {
  std::array<std::uint8_t, 4> size{};
  if (read_all(file_.number(), size, kKeptAt) < size.size() || load_big_endian(size) != kept.size()) return false;
  for (std::size_t at = 0; at < kept.size();) {
    std::array<std::uint8_t, 1024> bytes{};
    const std::span part = std::span(bytes).first(std::min(bytes.size(), kept.size() - at));
    if (read_all(file_.number(), part, kKeptAt + size.size() + at) < part.size()) return false;
    if (!std::ranges::equal(part, kept.subspan(at, part.size()))) return false;
    at += part.size();
  }
  return true;
}

/// A file system that cannot promise space (EOPNOTSUPP) is written to, which takes it.
bool RecordFile::hold_space() const {
  if (::fallocate(file_.number(), 0, 0, kRecordFileBytes) == 0) return true;
  if (errno != EOPNOTSUPP) return false;
  struct stat status {};
  if (::fstat(file_.number(), &status) != 0) return false;
  const Slot zeros{};
  for (auto at = static_cast<std::size_t>(status.st_size); at < kRecordFileBytes; at += zeros.size()) {
    if (!write_all(file_.number(), std::span(zeros).first(std::min(zeros.size(), kRecordFileBytes - at)), at)) return false;
  }
  return true;
}

bool RecordFile::prepare(std::span<const std::uint8_t> kept) {
  if (file_.number() < 0 && !open()) {
    if (is_anybodys_) (void)::unlink(path_.c_str());  // nobody would believe what is written there
    file_ = FileDescriptor(::open(path_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC | O_NOFOLLOW, kMode));
    is_writable_ = file_.number() >= 0;
  }
  if (!is_to_be_written() || !claim() || !hold_space()) return false;
  if (!kept.empty() && holds(kept)) return true;
  std::array<std::uint8_t, 4> size{};
  if (kept.size() > kMostKeptBytes - size.size()) return false;
  store_big_endian(size, kept.size());
  if (!write_all(file_.number(), size, kKeptAt) || !write_all(file_.number(), kept, kKeptAt + size.size())) return false;
  const FileDescriptor folder(::open(folder_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  return ::fsync(file_.number()) == 0 && folder.number() >= 0 && ::fsync(folder.number()) == 0;
}

bool RecordFile::put(const SafetyRecord& record, std::size_t slot) const {
  const Slot bytes = slot_of(record);
  return write_all(file_.number(), bytes, slot * kRecordSlotBytes) && ::fdatasync(file_.number()) == 0;
}

bool RecordFile::write(const SafetyRecord& record) {
  if (!is_to_be_written()) return false;
  const std::optional<Found> there = newest_slot(file_.number());
  if (!there) return put(record, 0);
  if (there->record == record) return ::fdatasync(file_.number()) == 0;  // it was not brought to the disk
  const bool is_higher = there->record.sequence >= record.sequence;
  const bool is_of_same_flight = there->record.journal_crc32 == record.journal_crc32;
  is_overtaken_ = is_overtaken_ || (is_higher && is_of_same_flight);
  if (is_overtaken_) return false;
  // A file that was away may hold a higher number of a flight of before: that is not to be found any more either.
  return put(record, (there->slot + 1) % kRecordSlots) && (!is_higher || put(record, there->slot));
}

bool RecordFile::is_in_place() const {
  struct stat opened {};
  struct stat named {};
  return ::fstat(file_.number(), &opened) == 0 && ::lstat(path_.c_str(), &named) == 0 && opened.st_dev == named.st_dev &&
         opened.st_ino == named.st_ino && opened.st_size >= static_cast<off_t>(kRecordFileBytes);
}

}  // namespace earshot::host
