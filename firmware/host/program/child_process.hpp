#pragma once

#include <sys/types.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace earshot::program {

/// What a child has otherwise than this program.
struct ChildSettings {
  std::filesystem::path words = {};           ///< file that its standard output and standard error are added to; empty: this program's own
  std::vector<std::string> environment = {};  ///< NAME=VALUE, beside this program's own
  std::uint64_t most_bytes_of_a_file = 0;     ///< what it writes beyond them is refused (EFBIG), as a full disk refuses it; 0: no limit
};

/// A program that stands beside this one, or anywhere if it is named with a path, started as a process of its own: in its own process group
/// (a terminal's Ctrl-C then reaches only this program, which ends the others in order), and ended with this process however that ends.
class ChildProcess {
 public:
  /// @throws std::system_error
  ChildProcess(std::string program, const std::vector<std::string>& arguments, const ChildSettings& settings = {});
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  [[nodiscard]] bool running() const { return status_ < 0; }
  /// Exit status, or 128 + signal; -1 while it runs.
  [[nodiscard]] int status() const { return status_; }
  void poll();
  void signal(int number);
  /// Asks it to end, once.
  void stop();
  /// Says on standard error what it could not say itself: that a signal which this program did not send has ended it.
  void report_signal(const std::string& reporter) const;

 private:
  std::string program_;
  pid_t id_ = 0;
  int status_ = -1;
  bool is_signalled_ = false;  ///< by signal() to end
};

/// The last line that a child said: often why it ended as it did.
/// @param words  ChildSettings::words
/// @return its first 200 bytes, printable; empty: it said nothing, or that cannot be read
[[nodiscard]] std::string last_words(const std::filesystem::path& words);

}  // namespace earshot::program
