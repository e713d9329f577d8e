#include "sim/netcdf/apart.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fstream>

namespace earshot::netcdf {
namespace {

void lower(decltype(RLIMIT_CPU) what, rlim_t limit) {
  rlimit now{};
  if (getrlimit(what, &now) != 0) return;
  now.rlim_cur = std::min(limit, now.rlim_max);
  (void)setrlimit(what, &now);
}

/// The child's own life: no core file, no words on the terminal, and none of the parent's handlers of signals.
[[noreturn]] void live_apart(const ApartLimits& limits, std::size_t memory_now, const std::function<void()>& work, bool* is_done) {
  for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGXCPU}) (void)std::signal(signal, SIG_DFL);
  if (const int nowhere = open("/dev/null", O_WRONLY); nowhere >= 0)
    (void)dup2(nowhere, STDERR_FILENO);  // NOLINT(cppcoreguidelines-pro-type-vararg)
  lower(RLIMIT_CORE, 0);
  lower(RLIMIT_CPU, limits.processor_time_s);
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // they have taken terabytes of addresses
  lower(RLIMIT_AS, memory_now + limits.more_memory);
#else
  (void)memory_now;
#endif
  try {
    work();
    *is_done = true;
  } catch (...) {
    _exit(1);
  }
  _exit(0);
}

std::size_t memory_now() {
  std::size_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return pages * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

std::string end_of(pid_t child, const ApartLimits& limits) {
  int status = 0;
  while (waitpid(child, &status, 0) == -1) {
    if (errno != EINTR) return "an unknown end";  // who ignores SIGCHLD is not told
  }
  if (!WIFSIGNALED(status)) return "status " + std::to_string(WEXITSTATUS(status));
  const int signal = WTERMSIG(status);
  if (signal == SIGXCPU) return "no end after " + std::to_string(limits.processor_time_s) + " s of processor time";
  return "signal " + std::to_string(signal) + " (" + strsignal(signal) + ")";
}

}  // namespace

SharedBytes::SharedBytes(std::size_t size)
    : size_(std::max<std::size_t>(size, 1)), data_(mmap(nullptr, size_, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0)) {
  if (data_ == MAP_FAILED) data_ = nullptr;
}

SharedBytes::~SharedBytes() {
  if (data_ != nullptr) (void)munmap(data_, size_);
}

std::optional<std::string> run_apart(const ApartLimits& limits, const std::function<void()>& work) {
  const SharedBytes shared(sizeof(bool));
  bool* const is_done = static_cast<bool*>(shared.data());
  if (is_done == nullptr) return "no memory for it";
  const std::size_t memory = memory_now();
  const pid_t child = fork();
  if (child == -1) return std::string("no process for it (") + std::strerror(errno) + ")";
  if (child == 0) live_apart(limits, memory, work, is_done);
  std::string end = end_of(child, limits);
  if (*is_done) return std::nullopt;
  return end;
}

}  // namespace earshot::netcdf
