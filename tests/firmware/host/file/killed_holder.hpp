#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "firmware/host/file/file_descriptor.hpp"

namespace earshot::support {

/// A process that took a file's lock, was killed and is still listed, and whose lock is still held: as when a disk hangs that it was
/// writing to. (Here a child of it keeps the lock, and nobody waits for it.)
class KilledHolder {
 public:
  /// @param name  of its program, for who asks the kernel
  KilledHolder(const std::filesystem::path& file, const char* name) {
    int locked[2], ended[2];
    EXPECT_EQ(::pipe(locked), 0);
    EXPECT_EQ(::pipe(ended), 0);
    process_ = ::fork();
    if (process_ == 0) {
      ::close(ended[1]);
      hold(file, name, locked[1], ended[0]);
    }
    ::close(ended[0]);
    ::close(locked[1]);
    ended_ = host::FileDescriptor(ended[1]);
    char word = 0;
    EXPECT_EQ(::read(locked[0], &word, 1), 1) << "it has the lock";
    ::close(locked[0]);
    ::kill(process_, SIGKILL);
    siginfo_t info{};
    EXPECT_EQ(::waitid(P_PID, static_cast<id_t>(process_), &info, WEXITED | WNOWAIT), 0);
  }
  ~KilledHolder() { ::waitpid(process_, nullptr, 0); }
  KilledHolder(const KilledHolder&) = delete;
  KilledHolder& operator=(const KilledHolder&) = delete;

  [[nodiscard]] std::string number() const { return std::to_string(process_); }

 private:
  [[noreturn]] static void hold(const std::filesystem::path& file, const char* name, int locked, int ended) {
    ::prctl(PR_SET_NAME, name);
    const int descriptor = ::open(file.c_str(), O_RDWR | O_CREAT, 0600);
    if (descriptor < 0 || ::flock(descriptor, LOCK_EX | LOCK_NB) != 0) std::_Exit(1);
    char word = '!';
    if (::fork() == 0) {  // keeps the lock until the test ends, or is over
      ::close(locked);
      (void)!::read(ended, &word, 1);
      std::_Exit(0);
    }
    if (::write(locked, &word, 1) == 1) ::pause();
    std::_Exit(1);
  }

  pid_t process_ = -1;
  host::FileDescriptor ended_;
};

}  // namespace earshot::support
