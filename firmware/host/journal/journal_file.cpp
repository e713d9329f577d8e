#include "firmware/host/journal/journal_file.hpp"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <optional>
#include <span>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "firmware/host/file/folder_lock.hpp"
#include "firmware/host/journal/journal_format.hpp"
#include "firmware/host/journal/journal_name.hpp"
#include "firmware/wire/lcm/channels.hpp"
#include "firmware/wire/lcm/encoding.hpp"

namespace earshot::host {
namespace {

constexpr std::string_view kPart = ".part";
constexpr std::size_t kMostDigits = 6;

[[noreturn]] void fail(const std::filesystem::path& path) {
  throw std::system_error(errno, std::generic_category(), path.string());
}

std::filesystem::path folder_of(const std::filesystem::path& path) {
  return path.has_parent_path() ? path.parent_path() : ".";
}

/// A journal that is there in any part, also one whose first part somebody took away.
int highest_number(const std::filesystem::path& wanted) {
  int highest = 0;
  for (const JournalName& name : journals_beside(wanted)) highest = std::max(highest, name.journal);
  return highest;
}

}  // namespace

JournalFile::JournalFile(const std::filesystem::path& wanted, ExistingJournal existing) : path_(wanted), wanted_(wanted) {
  open(wanted, existing);
  struct stat status {};
  if (::fstat(file_.number(), &status) != 0) fail(path_);
  folder_ = FileDescriptor(::open(folder_of(path_).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (!S_ISREG(status.st_mode)) return;
  mark_as_written(file_, path_);
  name_ = (path_.parent_path() / path_.stem()).string();
  name_ += kPart;
  stem_bytes_ = name_.size();
  extension_ = path_.extension().string();
  name_ += std::string(kMostDigits, '0') + extension_;
  if (existing == ExistingJournal::kGoOn) {
    const JournalParts parts(path_);
    const JournalParts::Place end = parts.place_of(parts.size());
    write_on_at(end, parts.size() - end.offset);
  } else {
    if (existing == ExistingJournal::kReplace) delete_later_parts(path_);
    cut(0);
  }
}

void JournalFile::open(const std::filesystem::path& wanted, ExistingJournal existing) {
  // What is replaced is emptied only when nobody writes it.
  const int mode = existing == ExistingJournal::kGoOn ? 0 : (existing == ExistingJournal::kReplace ? O_CREAT : O_CREAT | O_EXCL);
  const bool keeps = existing == ExistingJournal::kKeep;
  int number = keeps ? highest_number(wanted) + 1 : 1;
  for (;; ++number) {
    if (number > kMostJournals) throw std::system_error(ENOSPC, std::generic_category(), path_.string() + ": no number is left");
    path_ = named(wanted, {.journal = number});
    file_ = FileDescriptor(::open(path_.c_str(), O_WRONLY | O_CLOEXEC | mode, 0644));
    if (file_.number() >= 0) return;
    if (errno != EEXIST || !keeps) fail(path_);
  }
}

void JournalFile::keep_to(JournalLimits limits) {
  limits_ = limits;
  next_part_at_ = limits.part_bytes;
  if (limits.budget_bytes == 0) return;
  const std::optional<JournalName> own = name_of(wanted_, path_);
  old_ = OldJournals(wanted_, own ? own->journal : 0);
  (void)has_budget_for(2 * kJournalReserveBytes);
}

void JournalFile::cut(std::uint64_t size) {
  JournalParts::Place place{.part = 1, .file = path_, .offset = 0};
  if (size > 0) {
    const JournalParts parts(path_);
    place = parts.place_of(size);
    const std::vector<std::filesystem::path> files = parts.files();
    const auto last = std::ranges::find(files, place.file);
    delete_parts(std::span(files).last(static_cast<std::size_t>(files.end() - last) - 1));
  }
  write_on_at(place, size - place.offset);
  if (::ftruncate(file_.number(), static_cast<off_t>(place.offset)) != 0) fail(place.file);
}

void JournalFile::write_on_at(const JournalParts::Place& place, std::uint64_t earlier) {
  if (place.offset + earlier > 0) {
    const FileDescriptor beginning(::open(path_.c_str(), O_RDONLY | O_CLOEXEC));
    if (::read(beginning.number(), beginning_.data(), beginning_.size()) < 0) fail(path_);
  }
  if (place.part != part_) {
    if (part_ == 1) first_ = std::move(file_);
    // The mark hangs on the descriptor by which the first part was opened.
    file_ = place.part == 1 ? std::move(first_) : FileDescriptor(::open(place.file.c_str(), O_WRONLY | O_CLOEXEC));
    if (file_.number() < 0) fail(place.file);
  }
  const auto end = static_cast<off_t>(place.offset);
  if (::lseek(file_.number(), end, SEEK_SET) != end) fail(place.file);
  part_ = place.part;
  size_ = held_ = place.offset;
  earlier_bytes_ = earlier;
}

void JournalFile::keep_entry() const {
  if (folder_.number() < 0 || ::fsync(folder_.number()) != 0) fail(folder_of(path_));
}

std::size_t JournalFile::write_some(std::span<const std::uint8_t> bytes, std::uint64_t kept) {
  if (kept > 0) {
    while (can_hold_ && room(size_, kept) < bytes.size() && hold_more()) {
    }
    if (can_hold_) bytes = bytes.first(static_cast<std::size_t>(std::min<std::uint64_t>(bytes.size(), room(size_, kept))));
    if (!can_hold_ && !has_budget_for(bytes.size())) return 0;
  } else if (const std::uint64_t end = size_ + bytes.size(); end > held_ && !has_budget_for(end - held_)) {
    bytes = bytes.first(static_cast<std::size_t>(held_ - size_));
  }
  if (bytes.empty()) return 0;
  const ssize_t count = ::write(file_.number(), bytes.data(), bytes.size());
  if (count <= 0) return 0;
  const auto done = static_cast<std::size_t>(count);
  note_first_bytes(bytes.first(done));
  size_ += done;
  held_ = std::max(held_, size_);
  return done;
}

void JournalFile::note_first_bytes(std::span<const std::uint8_t> bytes) {
  if (part_ > 1 || size_ >= beginning_.size()) return;
  const std::span left = std::span(beginning_).subspan(static_cast<std::size_t>(size_));
  std::copy_n(bytes.begin(), std::min(bytes.size(), left.size()), left.begin());
}

bool JournalFile::has_budget_for(std::uint64_t bytes) {
  if (limits_.budget_bytes == 0) return true;
  while (old_.bytes() + earlier_bytes_ + std::max(held_, size_) + bytes > limits_.budget_bytes) {
    if (!old_.delete_oldest()) return false;
  }
  return true;
}

bool JournalFile::hold_more() {
  // Not every file system looks at the limit while the file itself does not grow.
  rlimit limit{};
  if (::getrlimit(RLIMIT_FSIZE, &limit) == 0 && held_ + kJournalReserveBytes > limit.rlim_cur) return false;
  if (!has_budget_for(kJournalReserveBytes)) return false;
  if (::fallocate(file_.number(), FALLOC_FL_KEEP_SIZE, static_cast<off_t>(held_), static_cast<off_t>(kJournalReserveBytes)) == 0) {
    held_ += kJournalReserveBytes;
    return true;
  }
  can_hold_ = errno == ENOSPC || errno == EDQUOT || errno == EFBIG || errno == EINTR;
  return false;
}

const char* JournalFile::name_of_part(int part) {
  std::array<char, kMostDigits> digits{};
  const auto [end, error] = std::to_chars(digits.data(), digits.data() + digits.size(), part);
  if (error != std::errc{}) return nullptr;
  const auto count = static_cast<std::size_t>(end - digits.data());
  char* const to = std::copy_n(digits.data(), count, name_.data() + stem_bytes_);
  *std::ranges::copy(extension_, to).out = '\0';  // within what stood there, or the string's own end
  return name_.c_str();
}

PartBegun JournalFile::refuse_part() {
  next_part_at_ = size_ + kJournalReserveBytes;  // tried again then
  return PartBegun::kNo;
}

PartBegun JournalFile::begin_part(bool is_to_survive) {
  if (earlier_bytes_ + size_ == 0) return PartBegun::kNo;  // what names the journal is still to come
  const std::uint64_t earlier = earlier_bytes_ + size_;
  if (!has_budget_for(2 * kJournalReserveBytes)) return refuse_part();
  FileDescriptor next;
  int number = part_;
  const char* name = nullptr;
  do {  // what stands in its place stays there, and a reader passes over it
    name = name_of_part(++number);
    if (name == nullptr) return refuse_part();
    next = FileDescriptor(::open(name, O_WRONLY | O_CLOEXEC | O_CREAT | O_EXCL | O_NOFOLLOW, 0644));
  } while (next.number() < 0 && errno == EEXIST);
  if (next.number() < 0) return refuse_part();
  const messages::JournalPart part{.part = static_cast<std::uint32_t>(number),
                                   .first_record_crc32 = static_cast<std::uint32_t>(load_big_endian(std::span(beginning_).subspan(4)))};
  const wire::Encoded data(part);
  const LoneRecord record(0, Time{}, wire::kJournalPartChannel, data.bytes());
  const bool is_held = !can_hold_ || ::fallocate(next.number(), FALLOC_FL_KEEP_SIZE, 0, static_cast<off_t>(2 * kJournalReserveBytes)) == 0;
  const auto size = static_cast<ssize_t>(record.bytes().size());
  if (!is_held || ::write(next.number(), record.bytes().data(), record.bytes().size()) != size) {
    (void)::unlink(name);
    return refuse_part();
  }
  // Space that it does not give back stays held, and does no harm.
  [[maybe_unused]] const int given_back = ::ftruncate(file_.number(), static_cast<off_t>(size_));
  const bool survives = !is_to_survive || (::fdatasync(next.number()) == 0 && folder_.number() >= 0 && ::fsync(folder_.number()) == 0);
  if (part_ == 1) first_ = std::move(file_);
  file_ = std::move(next);
  part_ = number;
  earlier_bytes_ = earlier;
  size_ = record.bytes().size();
  held_ = can_hold_ ? 2 * kJournalReserveBytes : size_;
  next_part_at_ = limits_.part_bytes;
  return survives ? PartBegun::kYes : PartBegun::kMayNotSurvive;
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
  first_ = FileDescriptor();
  return is_cut;
}

}  // namespace earshot::host
