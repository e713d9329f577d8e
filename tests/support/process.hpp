#pragma once

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

#include <sys/types.h>

namespace earshot::support {

/// A child process whose standard output and error go to one file. Killed when this object goes before it ended.
class Process {
 public:
  Process(const std::filesystem::path& program, const std::vector<std::string>& arguments, std::filesystem::path output);
  ~Process();
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  void signal(int number) const;
  /// Exit status, or 128 + signal; -1 if it still runs when `timeout` is over.
  [[nodiscard]] int wait(std::chrono::milliseconds timeout);
  [[nodiscard]] pid_t pid() const { return id_; }
  [[nodiscard]] std::string output() const;

 private:
  pid_t id_ = -1;
  int status_ = -1;
  std::filesystem::path output_;
};

[[nodiscard]] std::string read_text(const std::filesystem::path& path);

}  // namespace earshot::support
