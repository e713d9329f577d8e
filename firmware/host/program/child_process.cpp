#include "firmware/host/program/child_process.hpp"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <system_error>
#include <utility>

namespace earshot::program {
namespace {

void apply(const ChildSettings& settings) {
  if (!settings.words.empty()) {
    const int file = open(settings.words.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0644);
    if (file < 0 || dup2(file, STDOUT_FILENO) < 0 || dup2(file, STDERR_FILENO) < 0) _exit(2);
    (void)close(file);
  }
  if (settings.most_bytes_of_a_file == 0) return;
  (void)std::signal(SIGXFSZ, SIG_IGN);
  const rlimit limit{.rlim_cur = settings.most_bytes_of_a_file, .rlim_max = settings.most_bytes_of_a_file};
  (void)setrlimit(RLIMIT_FSIZE, &limit);
}

[[noreturn]] void become(const char* path, char* const* argv, const ChildSettings& settings, pid_t parent, const sigset_t& mask) {
  (void)std::signal(SIGINT, SIG_DFL);
  (void)std::signal(SIGTERM, SIG_DFL);
  (void)setpgid(0, 0);
  (void)std::signal(SIGTTOU, SIG_IGN);  // a terminal with `stty tostop` would halt it, in its own group, at its first word
  (void)prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (getppid() != parent) _exit(1);  // it has died meanwhile, and no signal will say so
  (void)sigprocmask(SIG_SETMASK, &mask, nullptr);
  apply(settings);
  (void)execv(path, argv);
  (void)std::fprintf(stderr, "%s: %s\n", path, std::strerror(errno));
  _exit(2);
}

}  // namespace

ChildProcess::ChildProcess(std::string program, const std::vector<std::string>& arguments, const ChildSettings& settings)
    : program_(std::move(program)) {
  const bool is_path = program_.find('/') != std::string::npos;
  const std::string path = is_path ? program_ : (std::filesystem::read_symlink("/proc/self/exe").parent_path() / program_).string();
  std::vector<char*> argv{const_cast<char*>(path.c_str())};
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  // A signal between fork and exec would meet this program's handler and be lost with it: it has to wait until the child has none.
  sigset_t all;
  sigset_t before;
  (void)sigfillset(&all);
  (void)sigprocmask(SIG_SETMASK, &all, &before);
  const pid_t parent = getpid();
  id_ = fork();
  if (id_ == 0) become(path.c_str(), argv.data(), settings, parent, before);
  const int error = errno;
  (void)sigprocmask(SIG_SETMASK, &before, nullptr);
  if (id_ < 0) throw std::system_error(error, std::generic_category(), program_);
}

void ChildProcess::poll() {
  int raw = 0;
  if (running() && waitpid(id_, &raw, WNOHANG) == id_) status_ = WIFEXITED(raw) ? WEXITSTATUS(raw) : 128 + WTERMSIG(raw);
}

void ChildProcess::signal(int number) {
  if (!running()) return;
  is_told_ = is_told_ || (number != SIGSTOP && number != SIGCONT);
  (void)kill(id_, number);
}

void ChildProcess::stop() {
  if (!is_told_) signal(SIGTERM);
}

void ChildProcess::report_signal(const std::string& reporter) const {
  const int number = status_ - 128;
  if (is_told_ || number <= 0 || number == SIGINT) return;
  (void)std::fprintf(stderr, "%s: %s was ended by signal %d (%s)\n", reporter.c_str(), program_.c_str(), number, strsignal(number));
}

}  // namespace earshot::program
