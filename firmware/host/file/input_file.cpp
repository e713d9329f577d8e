#include "firmware/host/file/input_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/file/file_type.hpp"
#include "firmware/host/file/printable.hpp"
#include "firmware/host/file/shipped.hpp"

namespace earshot::host {
namespace {

constexpr std::size_t kPiece_bytes = std::size_t{1} << 20U;

BadInput refused(const std::filesystem::path& path, const std::string& why) {
  return BadInput(printable(path.string()) + ": " + why);
}

BadInput unreadable(const std::filesystem::path& path, const std::string& why) {
  return refused(path, "cannot be read: " + why);
}

std::string why_not_read(mode_t mode) {
  const std::string type = std::string("it is ") + type_name(mode);
  if (S_ISDIR(mode)) return type;
  return type + ", and only regular files are read" + (S_ISFIFO(mode) ? ": write it to a file first" : "");
}

BadInput too_large(const std::filesystem::path& path, FileKind kind, std::uint64_t size) {
  return refused(path, "has " + std::to_string(size) + " bytes or more: " + kind.name + " has at most " + std::to_string(kind.most_bytes));
}

void require_acceptable(const std::filesystem::path& path, FileKind kind, const struct stat& status) {
  if (!S_ISREG(status.st_mode)) throw unreadable(path, why_not_read(status.st_mode));
  const auto size = static_cast<std::uint64_t>(status.st_size);
  if (size > kind.most_bytes) throw too_large(path, kind, size);
}

[[noreturn]] void fail(const std::filesystem::path& path, int error) {
  if (error == ENOENT || error == ENOTDIR) throw refused(path, "no such file" + shipped_instead(path));
  throw unreadable(path, std::strerror(error));
}

template <class Content>
Content content_of(const std::filesystem::path& path, FileKind kind) {
  InputFile file(path, kind);
  Content content;
  std::size_t size = 0;
  std::size_t piece_bytes = static_cast<std::size_t>(file.size()) + 1;  // no more: a folder of small files is read at once
  do {  // the size that was said is not to be relied on: files of /proc say 0
    content.resize(size + piece_bytes);
    const std::span<std::uint8_t> room(reinterpret_cast<std::uint8_t*>(content.data()), content.size());
    size += file.read(room.subspan(size));
    piece_bytes = kPiece_bytes;
  } while (size == content.size());
  content.resize(size);
  return content;
}

}  // namespace

InputFile::InputFile(std::filesystem::path path, FileKind kind) : path_(std::move(path)), kind_(kind) {
  struct stat status {};
  if (::stat(path_.c_str(), &status) != 0) fail(path_, errno);
  require_acceptable(path_, kind_, status);
  // Not to block, should it have become a pipe by now.
  file_ = FileDescriptor(::open(path_.c_str(), O_RDONLY | O_CLOEXEC | O_NOCTTY | O_NONBLOCK));
  if (file_.number() < 0 || ::fstat(file_.number(), &status) != 0) fail(path_, errno);
  require_acceptable(path_, kind_, status);
  size_ = static_cast<std::uint64_t>(status.st_size);
  mode_ = status.st_mode;
}

std::size_t InputFile::read(std::span<std::uint8_t> into) {
  std::size_t size = 0;
  while (size < into.size()) {
    const ssize_t got = ::read(file_.number(), into.data() + size, into.size() - size);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) fail(path_, errno);
    if (got == 0) break;
    size += static_cast<std::size_t>(got);
  }
  read_ += size;
  if (read_ > kind_.most_bytes) throw too_large(path_, kind_, read_);
  return size;
}

void InputFile::go_to(std::uint64_t offset) {
  const auto wanted = static_cast<off_t>(offset);
  if (::lseek(file_.number(), wanted, SEEK_SET) != wanted) fail(path_, errno);
  read_ = offset;
}

std::string read_text(const std::filesystem::path& path, FileKind kind) {
  return content_of<std::string>(path, kind);
}

std::vector<std::uint8_t> read_bytes(const std::filesystem::path& path, FileKind kind) {
  return content_of<std::vector<std::uint8_t>>(path, kind);
}

}  // namespace earshot::host
