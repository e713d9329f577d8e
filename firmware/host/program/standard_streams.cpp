#include "firmware/host/program/standard_streams.hpp"

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <iostream>
#include <utility>

namespace earshot::program {

void open_standard_streams() {
  for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    // The lowest number that is free: that of the closed one, for those below it are open.
    if (::fcntl(descriptor, F_GETFD) < 0) (void)!::open("/dev/null", O_RDONLY);
  }
}

NonBlockingStream::NonBlockingStream(std::ostream& stream, int descriptor)
    : stream_(stream), before_(stream.flush().rdbuf(this)), flags_before_(stream.flags()), descriptor_(descriptor) {
  stream_ << std::nounitbuf;  // standard error would be written word by word
}

NonBlockingStream::~NonBlockingStream() {
  stream_.flush();
  stream_.rdbuf(before_);
  stream_.flags(flags_before_);
}

NonBlockingStream::int_type NonBlockingStream::overflow(int_type character) {
  if (size_ == line_.size() && sync() != 0) return traits_type::eof();
  if (traits_type::eq_int_type(character, traits_type::eof())) return traits_type::not_eof(character);
  line_[size_++] = traits_type::to_char_type(character);
  return character == '\n' && sync() != 0 ? traits_type::eof() : character;
}

int NonBlockingStream::sync() {
  if (size_ == 0) return 0;
  const std::size_t size = std::exchange(size_, 0);
  if (!is_writable()) {
    ++left_out_;
    return 0;
  }
  if (left_out_ > 0) {
    std::array<char, 80> remark{};
    const int count = std::snprintf(remark.data(), remark.size(), "(%llu lines are left out here: nobody read them in time)\n",
                                    static_cast<unsigned long long>(left_out_));
    left_out_ = 0;
    if (!write({remark.data(), static_cast<std::size_t>(count)}) || !is_writable()) return -1;
  }
  return write_line({line_.data(), size}) ? 0 : -1;
}

bool NonBlockingStream::write_line(std::string_view line) const {
  if (!format_ || !line.ends_with('\n')) return write(line);
  line.remove_suffix(1);
  std::array<char, kLineBytes> formatted{};
  const std::string_view text = format_(line, std::span(formatted).first(formatted.size() - 1));
  std::array<char, kLineBytes> whole{};
  const auto end = std::ranges::copy(text.substr(0, whole.size() - 1), whole.begin()).out;
  *end = '\n';
  return write({whole.data(), static_cast<std::size_t>(end - whole.begin()) + 1});
}

/// As much as a line fits into a pipe of which poll(2) says that it can be written to.
bool NonBlockingStream::is_writable() {
  using std::chrono::steady_clock;
  const auto began = steady_clock::now();
  const auto deadline = began + patience_;
  for (;;) {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - steady_clock::now());
    pollfd waiting{.fd = descriptor_, .events = POLLOUT, .revents = 0};
    const int ready = ::poll(&waiting, 1, static_cast<int>(std::max<std::int64_t>(left.count(), 0)));
    if (ready < 0 && errno == EINTR) continue;
    const auto waited = std::chrono::duration_cast<std::chrono::milliseconds>(steady_clock::now() - began);
    patience_ = std::max(patience_ - waited, std::chrono::milliseconds(0));
    return ready == 1;
  }
}

bool NonBlockingStream::write(std::string_view text) const {
  while (!text.empty()) {
    const ssize_t count = ::write(descriptor_, text.data(), text.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return false;
    text.remove_prefix(static_cast<std::size_t>(count));
  }
  return true;
}

NonBlockingStdio::NonBlockingStdio() : output_(std::cout, STDOUT_FILENO), error_(std::cerr, STDERR_FILENO) {
  (void)std::signal(SIGPIPE, SIG_IGN);
}

}  // namespace earshot::program
