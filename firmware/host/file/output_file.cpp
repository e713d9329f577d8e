#include "firmware/host/file/output_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstddef>
#include <cstring>
#include <optional>
#include <string>

#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/file/file_type.hpp"
#include "firmware/host/file/input_file.hpp"
#include "firmware/host/file/printable.hpp"

namespace earshot::host {
namespace {

BadInput unwritable(const std::filesystem::path& path, const std::string& why) {
  return BadInput(printable(path.string()) + ": cannot be written: " + why);
}

/// Of what stands at `path` now; nothing where nothing does.
std::optional<mode_t> mode_at(const std::filesystem::path& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) == 0) return status.st_mode;
  if (errno != ENOENT) throw unwritable(path, std::strerror(errno));
  return std::nullopt;
}

constexpr mode_t mode_of(Access access) {
  constexpr mode_t kOwner = S_IRUSR | S_IWUSR;
  constexpr mode_t kOthersRead = S_IRGRP | S_IROTH;
  if (access == Access::kOwnerOnly) return kOwner;
  return access == Access::kOwnerWrites ? kOwner | kOthersRead : kOwner | kOthersRead | S_IWGRP | S_IWOTH;
}

/// The mode of the file that is to be replaced.
std::optional<mode_t> require_regular(const std::filesystem::path& path) {
  const std::optional<mode_t> mode = mode_at(path);
  if (mode && !S_ISREG(*mode)) throw unwritable(path, std::string("it is ") + type_name(*mode) + ", and only regular files are replaced");
  return mode;
}

bool holds(InputFile& file, std::string_view mark) {
  std::vector<std::uint8_t> piece(std::size_t{1} << 20U);
  std::size_t kept = 0;  // of the piece before: the mark may begin there
  while (true) {
    const std::size_t size = kept + file.read(std::span(piece).subspan(kept));
    if (std::string_view(reinterpret_cast<const char*>(piece.data()), size).find(mark) != std::string_view::npos) return true;
    if (size < piece.size()) return false;
    kept = mark.size() - 1;
    std::copy(piece.end() - static_cast<std::ptrdiff_t>(kept), piece.end(), piece.begin());
  }
}

bool is_of_kind(const std::filesystem::path& path, const OutputKind& kind) {
  std::array<std::uint8_t, 64> start{};
  InputFile file(path, kAnySize);
  const std::string_view text(reinterpret_cast<const char*>(start.data()), file.read(start));
  if (text.empty()) return true;
  if (!kind.is_recognisable) return false;
  const bool has_beginning = std::ranges::any_of(kind.beginnings, [](std::string_view b) { return !b.empty(); });
  if (has_beginning && std::ranges::none_of(kind.beginnings, [&](std::string_view b) { return !b.empty() && text.starts_with(b); }))
    return false;
  file.go_to(0);
  return kind.mark.empty() || holds(file, kind.mark);
}

/// Beside the target, and one for each process.
std::filesystem::path partial_of(const std::filesystem::path& target) {
  std::filesystem::path partial = target;
  partial += ".part" + std::to_string(::getpid());
  return partial;
}

/// How the kernel names a file that has none.
std::string open_file(const FileDescriptor& file) {
  return "/proc/self/fd/" + std::to_string(file.number());
}

bool bring_to_disk(const std::filesystem::path& folder) {
  const FileDescriptor file(::open(folder.c_str(), O_RDONLY | O_CLOEXEC | O_DIRECTORY));
  return file.number() >= 0 && ::fsync(file.number()) == 0;
}

/// Files that one program has under way at once: a table, its picture, and some to spare.
constexpr std::size_t kMost = 16;
std::array<std::atomic<const char*>, kMost> names{};
static_assert(std::atomic<const char*>::is_always_lock_free);
// A signal handler reads it.
std::atomic<pid_t> owner{0};
static_assert(std::atomic<pid_t>::is_always_lock_free);

/// The action is the default again by the time that this runs, and the signal not blocked.
void remove_and_end(int number) {
  if (::getpid() == owner) {
    for (const std::atomic<const char*>& name : names) {
      if (const char* const path = name) (void)::unlink(path);
    }
  }
  (void)::raise(number);
}

}  // namespace

UnfinishedName::UnfinishedName(const std::filesystem::path& path) : name_(path.string()) {
  for (std::atomic<const char*>& name : names) {
    const char* none = nullptr;
    if (!name.compare_exchange_strong(none, name_.c_str())) continue;
    slot_ = &name;
    return;
  }
}

UnfinishedName::~UnfinishedName() {
  if (slot_ != nullptr) *slot_ = nullptr;
}

void remove_unfinished_on_signals() {
  owner = ::getpid();
  for (const int number : {SIGHUP, SIGINT, SIGQUIT, SIGTERM}) {
    struct sigaction action {};
    if (::sigaction(number, nullptr, &action) != 0 || action.sa_handler != SIG_DFL) continue;
    action.sa_handler = remove_and_end;
    action.sa_flags = static_cast<int>(SA_RESETHAND) | SA_NODEFER;
    (void)::sigaction(number, &action, nullptr);
  }
}

OutputKind picture_kind(const std::filesystem::path& path) {
  return path.extension() == ".png" ? kPngOutput : kSvgOutput;
}

std::filesystem::path followed(const std::filesystem::path& path) {
  // As many as the kernel follows.
  constexpr int kMostLinks = 40;
  std::filesystem::path target = std::filesystem::absolute(path);
  std::error_code error;
  for (int links = 0; std::filesystem::is_symlink(std::filesystem::symlink_status(target, error)); ++links) {
    if (links == kMostLinks) throw unwritable(path, std::strerror(ELOOP));
    target = target.parent_path() / std::filesystem::read_symlink(target);
  }
  return target;
}

void require_writable(const std::filesystem::path& path, const OutputKind& kind, Replace replace, std::string_view instead) {
  const bool exists = require_regular(path).has_value();
  if (exists && replace == Replace::kOwnKind && !is_of_kind(path, kind))
    throw BadInput(printable(path.string()) + ": is there already and is not " + std::string(kind.name) + "; " + std::string(instead));
  const OutputFile trial(path);
}

OutputFile::OutputFile(const std::filesystem::path& path, Access access)
    : path_(path), target_(followed(path)), partial_(partial_of(target_)) {
  const std::optional<mode_t> older = require_regular(path);
  const mode_t made = mode_of(access);
  make_room_for_partial();
  if (!open_without_name(made)) open_partial(made);
  // Who may read it stays as it was, where the file system knows of that.
  if (older && access != Access::kOwnerOnly) (void)::fchmod(file_.number(), *older & 0777U);
}

void OutputFile::make_room_for_partial() const {
  struct stat status {};
  if (::lstat(partial_.c_str(), &status) != 0) {
    if (errno != ENOENT) throw unwritable(path_, std::strerror(errno));
  } else if (!S_ISREG(status.st_mode) || ::unlink(partial_.c_str()) != 0) {
    throw unwritable(path_, partial_.filename().string() + " is in the way");
  }
}

/// Not every file system can, and giving it a name later takes /proc.
bool OutputFile::open_without_name(mode_t mode) {
  file_ = FileDescriptor(::open(target_.parent_path().c_str(), O_WRONLY | O_TMPFILE | O_CLOEXEC, mode));
  return file_.number() >= 0 && ::access(open_file(file_).c_str(), F_OK) == 0;
}

void OutputFile::open_partial(mode_t mode) {
  name_.emplace(partial_);  // first, so that no signal comes in between
  file_ = FileDescriptor(::open(partial_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC | O_NOFOLLOW, mode));
  if (file_.number() >= 0) return;
  const int cause = errno;
  name_.reset();
  throw unwritable(path_, std::strerror(cause));
}

OutputFile::~OutputFile() {
  if (name_) ::unlink(partial_.c_str());
}

const std::filesystem::path& OutputFile::partial() {
  if (name_) return partial_;
  name_.emplace(partial_);
  if (::linkat(AT_FDCWD, open_file(file_).c_str(), AT_FDCWD, partial_.c_str(), AT_SYMLINK_FOLLOW) == 0) return partial_;
  const int cause = errno;
  name_.reset();
  throw unwritable(path_, std::strerror(cause));
}

void OutputFile::write(std::string_view content) {
  while (!content.empty()) {
    const ssize_t written = ::write(file_.number(), content.data(), content.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) throw unwritable(path_, std::strerror(errno));
    content.remove_prefix(static_cast<std::size_t>(written));
  }
}

void OutputFile::bring_content_to_disk() const {
  if (::fsync(file_.number()) != 0) throw unwritable(path_, std::strerror(errno));
}

void OutputFile::commit(Survives survives) {
  if (survives == Survives::kPowerCut) bring_content_to_disk();
  require_regular(target_);
  if (::rename(partial().c_str(), target_.c_str()) != 0) throw unwritable(path_, std::strerror(errno));
  name_.reset();
  // Not every file system can; the file is there all the same.
  if (survives == Survives::kPowerCut) (void)bring_to_disk(target_.parent_path());
}

void OutputFile::commit_as_new() {
  bring_content_to_disk();
  const bool is_named = name_ ? ::renameat2(AT_FDCWD, partial_.c_str(), AT_FDCWD, target_.c_str(), RENAME_NOREPLACE) == 0
                              : ::linkat(AT_FDCWD, open_file(file_).c_str(), AT_FDCWD, target_.c_str(), AT_SYMLINK_FOLLOW) == 0;
  if (!is_named) throw unwritable(path_, std::strerror(errno));
  name_.reset();
  (void)bring_to_disk(target_.parent_path());
}

void write_whole(const std::filesystem::path& path, std::string_view content, Access access) {
  OutputFile file(path, access);
  file.write(content);
  file.commit();
}

void write_new(const std::filesystem::path& path, std::string_view content, Access access) {
  OutputFile file(path, access);
  file.write(content);
  file.commit_as_new();
}

}  // namespace earshot::host
