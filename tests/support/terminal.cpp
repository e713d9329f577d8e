#include "tests/support/terminal.hpp"

#include <pty.h>
#include <sys/wait.h>
#include <termios.h>
#include <unistd.h>
#include <array>
#include <csignal>
#include <cstddef>

namespace earshot::support {

namespace {

/// As `stty tostop` does on this process's terminal.
void halt_background_writers() {
  termios settings{};
  (void)tcgetattr(STDOUT_FILENO, &settings);
  settings.c_lflag |= static_cast<tcflag_t>(TOSTOP);
  (void)tcsetattr(STDOUT_FILENO, TCSANOW, &settings);
}

}  // namespace

Shown shown_on_terminal(const std::filesystem::path& program, const std::vector<std::string>& arguments, const std::string& until) {
  std::vector<char*> argv{const_cast<char*>(program.c_str())};
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  int terminal = -1;
  const pid_t id = forkpty(&terminal, nullptr, nullptr, nullptr);
  if (id < 0) return {};
  if (id == 0) {
    constexpr unsigned kLongest_s = 60;
    (void)alarm(kLongest_s);
    halt_background_writers();
    (void)execv(program.c_str(), argv.data());
    _exit(127);
  }
  Shown shown;
  std::array<char, 4096> some{};
  while (until.empty() || shown.text.find(until) == std::string::npos) {
    const ssize_t count = read(terminal, some.data(), some.size());
    if (count <= 0) break;  // everybody has closed it
    shown.text.append(some.data(), static_cast<std::size_t>(count));
  }
  if (!until.empty()) (void)kill(id, SIGKILL);
  int raw = 0;
  if (waitpid(id, &raw, 0) == id) shown.status = WIFEXITED(raw) ? WEXITSTATUS(raw) : 128 + WTERMSIG(raw);
  (void)close(terminal);
  return shown;
}

}  // namespace earshot::support
