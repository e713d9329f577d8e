#include "firmware/host/file/process.hpp"

#include <gtest/gtest.h>

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "tests/support/temporary_folder.hpp"

namespace earshot::host {
namespace {

namespace fs = std::filesystem;

class Process : public testing::Test {
 protected:
  /// Of a process's folder: what the kernel prints of one of its threads.
  void thread(const std::string& number, const std::string& status) {
    const fs::path folder = fs::path(folder_) / "task" / number;
    fs::create_directories(folder);
    std::ofstream(folder / "status") << status;
  }
  const support::TemporaryFolder folder_;
};

constexpr const char* kSleeps =
    "Name:\tearshotd\nState:\tS (sleeping)\nVmSize:\t  141316 kB\nSigPnd:\t0000000000000000\nShdPnd:\t0000000000004000\n";
constexpr const char* kHangs =
    "Name:\tearshotd\nState:\tD (disk sleep)\nVmSize:\t  141316 kB\nSigPnd:\t0000000000000100\nShdPnd:\t0000000000000100\n";
constexpr const char* kEnded = "Name:\tearshotd\nState:\tZ (zombie)\nSigPnd:\t0000000000000000\nShdPnd:\t0000000000000000\n";

TEST_F(Process, IsKilledWhenSigkillWaitsForADiskInEachOfItsThreads) {
  thread("4711", kHangs);
  thread("4712", kHangs);
  EXPECT_TRUE(is_killed(folder_));
}

TEST_F(Process, IsKilledThoughItsFirstThreadHasEnded) {
  thread("4711", kEnded);
  thread("4712", kHangs);
  EXPECT_TRUE(is_killed(folder_));
}

TEST_F(Process, IsNotKilledWhileAThreadRunsThoughAnotherHasEnded) {
  thread("4711", kEnded);
  thread("4712", kSleeps);
  EXPECT_FALSE(is_killed(folder_));
}

TEST_F(Process, IsNotKilledByASignalThatItMayStillObey) {
  thread("4711", kSleeps);  // SIGTERM is pending
  EXPECT_FALSE(is_killed(folder_));
}

TEST_F(Process, IsNotKilledWhereItCannotBeTold) {
  EXPECT_FALSE(is_killed(fs::path(folder_) / "none"));
  thread("4711", "");
  EXPECT_FALSE(is_killed(folder_));
  EXPECT_FALSE(is_killed("/proc/self"));
}

TEST_F(Process, IsNamedWithItsNumber) {
  EXPECT_EQ(name_of_process(std::to_string(::getpid())), "host_file_test (process " + std::to_string(::getpid()) + ")");
  EXPECT_EQ(name_of_process("0"), "a program (process 0)");
}

}  // namespace
}  // namespace earshot::host
