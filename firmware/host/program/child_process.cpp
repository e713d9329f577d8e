#include "firmware/host/program/child_process.hpp"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string_view>
#include <system_error>
#include <utility>

#include "firmware/host/file/printable.hpp"

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

/// What is added takes the place of this program's own of that name.
std::vector<char*> environment_of(const ChildSettings& settings) {
  std::vector<char*> variables;
  for (const std::string& variable : settings.environment) variables.push_back(const_cast<char*>(variable.c_str()));
  const auto is_added = [&settings](std::string_view own) {
    return std::ranges::any_of(settings.environment, [own](const std::string& added) {
      return own.starts_with(std::string_view(added).substr(0, added.find('=') + 1));
    });
  };
  for (char** variable = environ; *variable != nullptr; ++variable) {
    if (!is_added(*variable)) variables.push_back(*variable);
  }
  variables.push_back(nullptr);
  return variables;
}

[[noreturn]] void become(const char* path, char* const* argv, char* const* environment, const ChildSettings& settings, pid_t parent,
                         const sigset_t& mask) {
  (void)std::signal(SIGINT, SIG_DFL);
  (void)std::signal(SIGTERM, SIG_DFL);
  (void)setpgid(0, 0);
  (void)std::signal(SIGTTOU, SIG_IGN);  // a terminal with `stty tostop` would halt it, in its own group, at its first word
  (void)prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (getppid() != parent) _exit(1);  // it has died meanwhile, and no signal will say so
  (void)sigprocmask(SIG_SETMASK, &mask, nullptr);
  apply(settings);
  (void)execve(path, argv, environment);
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
  const std::vector<char*> environment = environment_of(settings);
  // A signal between fork and exec would meet this program's handler and be lost with it: it has to wait until the child has none.
  sigset_t all;
  sigset_t before;
  (void)sigfillset(&all);
  (void)sigprocmask(SIG_SETMASK, &all, &before);
  const pid_t parent = getpid();
  id_ = fork();
  if (id_ == 0) become(path.c_str(), argv.data(), environment.data(), settings, parent, before);
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
  is_signalled_ = is_signalled_ || (number != SIGSTOP && number != SIGCONT);
  (void)kill(id_, number);
}

void ChildProcess::stop() {
  if (!is_signalled_) signal(SIGTERM);
}

void ChildProcess::report_signal(const std::string& reporter) const {
  const int number = status_ - 128;
  if (is_signalled_ || number <= 0 || number == SIGINT) return;
  (void)std::fprintf(stderr, "%s: %s was ended by signal %d (%s)\n", reporter.c_str(), program_.c_str(), number, strsignal(number));
}

std::string last_words(const std::filesystem::path& words) {
  constexpr std::size_t kMost = 200;
  std::ifstream file(words);
  std::string last;
  for (std::string line; std::getline(file, line);) {
    if (!line.empty()) last = line.substr(0, kMost);
  }
  return host::printable(last);
}

}  // namespace earshot::program
