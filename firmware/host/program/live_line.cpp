#include "firmware/host/program/live_line.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <cstddef>

#include "firmware/host/program/talk.hpp"

namespace earshot::program {
namespace {

constexpr std::chrono::milliseconds kBetweenDrawings{250};

std::FILE* terminal() {
  if (talk() == Talk::kQuiet) return nullptr;
  if (isatty(STDERR_FILENO) == 1) return stderr;
  return isatty(STDOUT_FILENO) == 1 ? stdout : nullptr;
}

/// A line that wraps could not be erased; one that fills the last column wraps on some terminals. 0 columns: the terminal does not know.
std::string fitted(const std::string& text, std::FILE* terminal) {
  struct winsize size {};
  if (ioctl(fileno(terminal), TIOCGWINSZ, &size) != 0 || size.ws_col == 0) return text;
  return text.substr(0, static_cast<std::size_t>(size.ws_col) - 1);
}

}  // namespace

LiveLine::LiveLine() : terminal_(terminal()) {}

LiveLine::~LiveLine() {
  if (!is_drawn_) return;
  (void)std::fputs("\r\033[K", terminal_);
  (void)std::fflush(terminal_);
}

bool LiveLine::is_due() const {
  return terminal_ != nullptr && steady_clock::now() >= due_;
}

void LiveLine::draw(const std::string& text) {
  if (terminal_ == nullptr) return;
  (void)std::fprintf(terminal_, "\r%s\033[K", fitted(text, terminal_).c_str());
  (void)std::fflush(terminal_);
  due_ = steady_clock::now() + kBetweenDrawings;
  is_drawn_ = true;
}

}  // namespace earshot::program
