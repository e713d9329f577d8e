#include "tests/support/process.hpp"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>
#include <csignal>
#include <fstream>
#include <iterator>
#include <system_error>
#include <thread>
#include <utility>

namespace earshot::support {

namespace {

/// Makes `path` the child's stream `descriptor`.
void redirect(const std::filesystem::path& path, int descriptor) {
  const int file = open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
  (void)dup2(file, descriptor);
}

}  // namespace

Process::Process(const std::filesystem::path& program, const std::vector<std::string>& arguments, std::filesystem::path output)
    : output_(std::move(output)) {
  start(program, arguments, {.folder = {}, .output = output_, .errors = {}});
}

Process::Process(const std::filesystem::path& program, const std::vector<std::string>& arguments, const Surroundings& surroundings)
    : output_(surroundings.output) {
  start(program, arguments, surroundings);
}

void Process::start(const std::filesystem::path& program, const std::vector<std::string>& arguments, const Surroundings& surroundings) {
  std::vector<char*> argv{const_cast<char*>(program.c_str())};
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  // What a program of before said there is gone before anybody waits for a word of this one.
  std::error_code error;
  if (std::filesystem::is_regular_file(surroundings.output, error)) std::filesystem::resize_file(surroundings.output, 0, error);
  id_ = fork();
  if (id_ != 0) return;
  redirect(surroundings.output, 1);
  if (surroundings.errors.empty())
    (void)dup2(1, 2);
  else
    redirect(surroundings.errors, 2);
  if (!surroundings.folder.empty() && chdir(surroundings.folder.c_str()) != 0) _exit(127);
  (void)execv(program.c_str(), argv.data());
  _exit(127);
}

Process::~Process() {
  if (wait(std::chrono::milliseconds(0)) >= 0) return;
  signal(SIGKILL);
  (void)wait(std::chrono::seconds(5));
}

void Process::signal(int number) const {
  if (status_ < 0) (void)kill(id_, number);
}

int Process::wait(std::chrono::milliseconds timeout) {
  const auto deadline = std::chrono::steady_clock::now() + timeout;
  for (;;) {
    int raw = 0;
    if (status_ < 0 && waitpid(id_, &raw, WNOHANG) == id_) status_ = WIFEXITED(raw) ? WEXITSTATUS(raw) : 128 + WTERMSIG(raw);
    if (status_ >= 0 || std::chrono::steady_clock::now() >= deadline) return status_;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
}

std::string Process::output() const {
  return read_text(output_);
}

std::string read_text(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

}  // namespace earshot::support
