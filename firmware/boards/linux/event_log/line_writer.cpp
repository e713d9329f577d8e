#include "firmware/boards/linux/event_log/line_writer.hpp"

#include <poll.h>
#include <pthread.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>

namespace earshot::board {
namespace {

constexpr std::chrono::milliseconds kPollInterval{100};  ///< how often who waits for a reader looks whether it is to end
constexpr std::chrono::seconds kLastPatience{1};         ///< with a reader who does not read, at the end

/// A reader who is gone makes write(2) fail, and not this process end.
void leave_out_broken_pipes() {
  sigset_t signals{};
  (void)sigemptyset(&signals);
  (void)sigaddset(&signals, SIGPIPE);
  (void)::pthread_sigmask(SIG_BLOCK, &signals, nullptr);
}

}  // namespace

LineWriter::LineWriter(int descriptor) : descriptor_(descriptor), writing_([this](const std::stop_token& stop) { write(stop); }) {}

void LineWriter::append(std::string_view line) {
  const std::uint64_t number = appended_.load(std::memory_order_relaxed);
  if (number - written_.load(std::memory_order_acquire) >= kLines) {
    ++left_out_;
    return;
  }
  Line& to = (*lines_)[number % kLines];
  to.size = std::min(line.size(), kLineBytes - 1);
  std::copy_n(line.begin(), to.size, to.text.begin());
  to.text[to.size++] = '\n';
  appended_.store(number + 1, std::memory_order_release);
  wake_event_.signal();
}

/// Less than PIPE_BUF fits into a pipe of which poll(2) says that it can be written to.
bool LineWriter::is_writable(const std::stop_token& stop) const {
  using std::chrono::steady_clock;
  auto deadline = steady_clock::time_point::max();
  for (;;) {
    pollfd waiting{.fd = descriptor_, .events = POLLOUT, .revents = 0};
    if (::poll(&waiting, 1, static_cast<int>(kPollInterval.count())) == 1) return true;
    if (!stop.stop_requested()) continue;
    deadline = std::min(deadline, steady_clock::now() + kLastPatience);
    if (steady_clock::now() >= deadline) return false;
  }
}

void LineWriter::write(const std::stop_token& stop) {
  (void)::pthread_setname_np(::pthread_self(), "event-log");  // for who lists the threads of a flight
  leave_out_broken_pipes();
  const std::stop_callback waking(stop, [this] { wake_event_.signal(); });
  for (bool is_last = false; !is_last;) {
    pollfd waiting{.fd = wake_event_.file_descriptor(), .events = POLLIN, .revents = 0};
    (void)::poll(&waiting, 1, -1);
    wake_event_.clear();
    is_last = stop.stop_requested();  // before the lines are written: what was said before it is written
    for (std::uint64_t number = written_; number < appended_.load(std::memory_order_acquire);
         written_.store(++number, std::memory_order_release)) {
      if (!is_writable(stop)) return;
      const Line& line = (*lines_)[number % kLines];
      (void)!::write(descriptor_, line.text.data(), line.size);  // where it cannot be said there is nobody to tell
    }
  }
}

}  // namespace earshot::board
