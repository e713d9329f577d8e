#pragma once

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

#include <sys/types.h>

namespace earshot::support {

/// Where a child process runs and what it writes to.
struct Surroundings {
  std::filesystem::path folder;  ///< it runs there
  std::filesystem::path output;  ///< its standard output
  std::filesystem::path errors;  ///< its standard error
};

/// A child process. Killed when this object goes before it ended.
class Process {
 public:
  /// Standard output and error go to one file.
  Process(const std::filesystem::path& program, const std::vector<std::string>& arguments, std::filesystem::path output);
  /// @param program  absolute, or from the folder that it runs in
  Process(const std::filesystem::path& program, const std::vector<std::string>& arguments, const Surroundings& surroundings);
  ~Process();
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  void signal(int number) const;
  /// Exit status, or 128 + signal; -1 if it still runs when `timeout` is over.
  [[nodiscard]] int wait(std::chrono::milliseconds timeout);
  [[nodiscard]] pid_t pid() const { return id_; }
  [[nodiscard]] std::string output() const;

 private:
  void start(const std::filesystem::path& program, const std::vector<std::string>& arguments, const Surroundings& surroundings);

  pid_t id_ = -1;
  int status_ = -1;
  std::filesystem::path output_;
};

[[nodiscard]] std::string read_text(const std::filesystem::path& path);

}  // namespace earshot::support
