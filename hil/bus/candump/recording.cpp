#include "hil/bus/candump/recording.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <string_view>
#include <utility>

#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/file/output_file.hpp"

namespace earshot::hil {

namespace {

/// It begins with a stamp: seconds since 1970 of ten digits, from 2001 until 2033 with a 1 (later: 2), without a clock with a 0.
constexpr host::OutputKind kCandumpLog{"a log of candump", {"(1", "(0"}};

host::BadInput refused(const std::filesystem::path& path, const std::string& why) {
  return host::BadInput(path.string() + ": " + why);
}

}  // namespace

Recording::Recording(std::filesystem::path path, OlderRecording older) : path_(std::move(path)) {
  host::require_writable(path_, kCandumpLog, older == OlderRecording::kIsReplaced ? host::Replace::kAny : host::Replace::kOwnKind,
                         "--replace replaces it");
  constexpr mode_t kMode = S_IRUSR | S_IWUSR | S_IRGRP | S_IWGRP | S_IROTH | S_IWOTH;
  file_ = host::FileDescriptor(::open(host::followed(path_).c_str(), O_WRONLY | O_CREAT | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK, kMode));
  struct stat status {};
  if (file_.number() < 0 || ::fstat(file_.number(), &status) != 0) fail(errno);
  if (!S_ISREG(status.st_mode)) throw refused(path_, "is no regular file");
  if (::flock(file_.number(), LOCK_EX | LOCK_NB) != 0) throw refused(path_, "another program is recording into it");
  // Asked of the open file: another recording may have come and gone since the name was judged.
  if (::fstat(file_.number(), &status) != 0) fail(errno);
  if (status.st_size > 0 && older == OlderRecording::kIsKept)
    throw refused(path_, "holds a recording already; --replace replaces it, another name keeps both");
  if (::ftruncate(file_.number(), 0) != 0) fail(errno);
}

void Recording::add(const LogEntry& entry) {
  waiting_ += log_line(entry.time.value_or(Time{}), entry.interface, *entry.frame);
}

void Recording::fail(int error) {
  throw refused(path_, std::string("cannot be written: ") + std::strerror(error));
}

void Recording::flush() {
  std::string_view rest = waiting_;
  while (!rest.empty()) {
    const ssize_t written = ::write(file_.number(), rest.data(), rest.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) {
      const int error = errno;
      keep_whole_lines(waiting_.size() - rest.size());
      fail(error);
    }
    rest.remove_prefix(static_cast<std::size_t>(written));
  }
  keep_whole_lines(waiting_.size());
}

void Recording::keep_whole_lines(std::size_t written) {
  const std::string_view out = std::string_view(waiting_).substr(0, written);
  const std::size_t whole = out.substr(0, out.rfind('\n') + 1).size();
  frames_ += static_cast<std::uint64_t>(std::count(out.begin(), out.end(), '\n'));
  size_ += whole;
  // Where even that fails, a reader finds one line that is damaged.
  if (whole < written) (void)!::ftruncate(file_.number(), static_cast<off_t>(size_));
  waiting_.clear();
}

void Recording::finish() {
  flush();
  if (::fsync(file_.number()) != 0) fail(errno);
}

}  // namespace earshot::hil
