#include "firmware/host/file/output_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
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

/// The mode of the file that is to be replaced.
std::optional<mode_t> require_regular(const std::filesystem::path& path) {
  const std::optional<mode_t> mode = mode_at(path);
  if (mode && !S_ISREG(*mode)) throw unwritable(path, std::string("it is ") + type_name(*mode) + ", and only regular files are replaced");
  return mode;
}

bool is_of_kind(const std::filesystem::path& path, const OutputKind& kind) {
  std::array<std::uint8_t, 64> start{};
  const std::size_t size = InputFile(path, kAnySize).read(start);
  const std::string_view text(reinterpret_cast<const char*>(start.data()), size);
  return text.empty() || std::ranges::any_of(kind.beginnings, [&](std::string_view b) { return !b.empty() && text.starts_with(b); });
}

/// Beside the target, and one for each process.
std::filesystem::path partial_of(const std::filesystem::path& target) {
  std::filesystem::path partial = target;
  partial += ".part" + std::to_string(::getpid());
  return partial;
}

bool bring_to_disk(const std::filesystem::path& folder) {
  const FileDescriptor file(::open(folder.c_str(), O_RDONLY | O_CLOEXEC | O_DIRECTORY));
  return file.number() >= 0 && ::fsync(file.number()) == 0;
}

}  // namespace

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

void require_writable(const std::filesystem::path& path, const OutputKind& kind, Replace replace) {
  const bool exists = require_regular(path).has_value();
  if (exists && replace == Replace::kOwnKind && !is_of_kind(path, kind))
    throw BadInput(printable(path.string()) + ": is there already and is not " + std::string(kind.name) + "; --force replaces it");
  const OutputFile trial(path);
}

OutputFile::OutputFile(const std::filesystem::path& path, Access access)
    : path_(path), target_(followed(path)), partial_(partial_of(target_)) {
  const std::optional<mode_t> older = require_regular(path);
  const mode_t made = access == Access::kOwnerOnly ? S_IRUSR | S_IWUSR : S_IRUSR | S_IWUSR | S_IRGRP | S_IWGRP | S_IROTH | S_IWOTH;
  // One that a killed process of the same number left.
  if (std::error_code error; std::filesystem::is_regular_file(std::filesystem::symlink_status(partial_, error)))
    std::filesystem::remove(partial_, error);
  file_ = FileDescriptor(::open(partial_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC | O_NOFOLLOW, made));
  if (file_.number() < 0) {
    const std::string why = std::strerror(errno);
    partial_.clear();
    throw unwritable(path_, why);
  }
  // Who may read it stays as it was, where the file system knows of that.
  if (older && access == Access::kEveryone) (void)::fchmod(file_.number(), *older & 0777U);
}

OutputFile::~OutputFile() {
  std::error_code ignored;
  if (!partial_.empty()) std::filesystem::remove(partial_, ignored);
}

void OutputFile::write(std::string_view content) {
  while (!content.empty()) {
    const ssize_t written = ::write(file_.number(), content.data(), content.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) throw unwritable(path_, std::strerror(errno));
    content.remove_prefix(static_cast<std::size_t>(written));
  }
}

void OutputFile::commit(Survives survives) {
  if (survives == Survives::kPowerCut && ::fsync(file_.number()) != 0) throw unwritable(path_, std::strerror(errno));
  require_regular(target_);
  if (::rename(partial_.c_str(), target_.c_str()) != 0) throw unwritable(path_, std::strerror(errno));
  partial_.clear();
  // Not every file system can; the file is there all the same.
  if (survives == Survives::kPowerCut) (void)bring_to_disk(target_.parent_path());
}

void write_whole(const std::filesystem::path& path, std::string_view content, Access access) {
  OutputFile file(path, access);
  file.write(content);
  file.commit();
}

}  // namespace earshot::host
