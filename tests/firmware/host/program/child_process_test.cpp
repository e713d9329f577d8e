#include "firmware/host/program/child_process.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <thread>

#include "tests/support/process.hpp"
#include "tests/support/temporary_folder.hpp"

namespace earshot::program {
namespace {

class ChildProcessTest : public testing::Test {
 protected:
  static int status_of(ChildProcess& child) {
    for (const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(60);
         child.running() && std::chrono::steady_clock::now() < deadline;) {
      child.poll();
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    return child.status();
  }
  /// Runs a line of shell to its end.
  static int run(const std::string& line, const ChildSettings& settings) {
    ChildProcess child("/bin/sh", {"-c", line}, settings);
    return status_of(child);
  }

  const support::TemporaryFolder folder_;
  const std::filesystem::path words_ = folder_ / "words.txt";
};

TEST_F(ChildProcessTest, HasItsExitStatus) {
  EXPECT_EQ(run("exit 7", {}), 7);
}

TEST_F(ChildProcessTest, HasTheStatusOfTheSignalThatEndedIt) {
  ChildProcess child("/bin/sleep", {"60"});
  EXPECT_EQ(child.status(), -1);
  child.signal(SIGKILL);
  EXPECT_EQ(status_of(child), 137) << "128 + 9";
}

TEST_F(ChildProcessTest, IsHaltedAndGoesOn) {
  ChildProcess child("/bin/sh", {"-c", "exit 3"});
  child.signal(SIGSTOP);
  child.poll();
  child.signal(SIGCONT);
  EXPECT_EQ(status_of(child), 3);
}

TEST_F(ChildProcessTest, EndsWhenItIsAskedToAfterItWasHaltedAndWentOn) {
  ChildProcess child("/bin/sh", {"-c", "exec sleep 30"});
  child.signal(SIGSTOP);
  child.signal(SIGCONT);
  child.stop();
  EXPECT_EQ(status_of(child), 143) << "128 + 15";
}

TEST_F(ChildProcessTest, AddsBothOfItsOutputsToTheFileOfItsWords) {
  EXPECT_EQ(run("echo one; echo two >&2", {.words = words_}), 0);
  EXPECT_EQ(run("echo three", {.words = words_}), 0);
  EXPECT_EQ(support::read_text(words_), "one\ntwo\nthree\n");
}

TEST_F(ChildProcessTest, SaysInTheFileOfItsWordsThatThereIsNoSuchProgram) {
  ChildProcess child((folder_ / "none").string(), {}, {.words = words_});
  EXPECT_EQ(status_of(child), 2);
  EXPECT_EQ(support::read_text(words_), (folder_ / "none").string() + ": No such file or directory\n");
}

TEST_F(ChildProcessTest, EndsWhereTheFileOfItsWordsCannotBe) {
  EXPECT_EQ(run("exit 0", {.words = folder_ / "no/such/folder/words.txt"}), 2);
}

TEST_F(ChildProcessTest, WritesNoFileBeyondItsLimitAndIsNotKilledForIt) {
  const std::string file = (folder_ / "large").string();
  EXPECT_EQ(run("head -c 10000 /dev/zero > " + file + "; echo then $?", {.words = words_, .most_bytes_of_a_file = 4096}), 0);
  EXPECT_EQ(std::filesystem::file_size(file), 4096U);
  EXPECT_NE(support::read_text(words_).find("then 1\n"), std::string::npos) << support::read_text(words_);
}

TEST_F(ChildProcessTest, HasWhatIsAddedToItsEnvironmentBesideThisProgramsOwn) {
  ::setenv("EARSHOT_TEST_OWN", "ours", 1);
  ::setenv("EARSHOT_TEST_BOTH", "ours", 1);
  EXPECT_EQ(run("echo $EARSHOT_TEST_OWN $EARSHOT_TEST_BOTH", {.words = words_, .environment = {"EARSHOT_TEST_BOTH=another's"}}), 0);
  EXPECT_EQ(support::read_text(words_), "ours another's\n");
}

TEST_F(ChildProcessTest, WritesAnyFileWithoutALimit) {
  const std::string file = (folder_ / "large").string();
  EXPECT_EQ(run("head -c 10000 /dev/zero > " + file, {.words = words_}), 0);
  EXPECT_EQ(std::filesystem::file_size(file), 10'000U);
}

TEST_F(ChildProcessTest, HasLastWordsThatCanBePrinted) {
  EXPECT_EQ(run("echo one; printf 'two \\033[1m\\n\\n'", {.words = words_}), 0);
  EXPECT_EQ(last_words(words_), "two \\x1b[1m") << "an empty line says nothing";
  EXPECT_EQ(run("printf %0300d 7", {.words = words_}), 0);
  EXPECT_EQ(last_words(words_), std::string(200, '0'));
}

TEST_F(ChildProcessTest, HasNoLastWordsThatNobodySaid) {
  EXPECT_EQ(last_words(words_), "");
  EXPECT_EQ(run("exit 0", {.words = words_}), 0);
  EXPECT_EQ(last_words(words_), "");
}

}  // namespace
}  // namespace earshot::program
