#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <vector>

#include "firmware/host/file/output_file.hpp"
#include "tests/support/temporary_folder.hpp"

namespace earshot::host {
namespace {

namespace fs = std::filesystem;

constexpr int kStopping[] = {SIGHUP, SIGINT, SIGQUIT, SIGTERM};

/// What a child process ends with that does `work`, as waitpid() tells it.
template <typename Work>
int status_of_child(Work work) {
  const pid_t child = fork();
  if (child == 0) {
    work();
    std::_Exit(9);
  }
  int status = 0;
  EXPECT_EQ(waitpid(child, &status, 0), child);
  return status;
}

class UnfinishedNameTest : public testing::Test {
 protected:
  const support::TemporaryFolder folder_;
};

TEST_F(UnfinishedNameTest, OfAFileThatALibraryWritesIsGoneWhenASignalEndsTheProgram) {
  for (const int number : kStopping) {
    const int status = status_of_child([&] {
      remove_unfinished_on_signals();
      OutputFile first(folder_ / "first");
      OutputFile second(folder_ / "second");
      std::ofstream(first.partial()) << "half";
      std::ofstream(second.partial()) << "half";
      (void)std::raise(number);
    });
    EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == number) << number << ": it ends as it would have";
    EXPECT_TRUE(fs::is_empty(folder_.path())) << number;
  }
}

TEST_F(UnfinishedNameTest, StaysNoneWhenTheFileIsWholeOrLeft) {
  status_of_child([&] {
    remove_unfinished_on_signals();
    const fs::path path = folder_ / "file";
    { const UnfinishedName name(path); }
    std::ofstream(path) << "another's";
    (void)std::raise(SIGTERM);
  });
  EXPECT_TRUE(fs::exists(folder_ / "file"));
}

TEST_F(UnfinishedNameTest, StaysWhereASignalIsIgnoredOrTheProgramStopsInItsOwnWay) {
  const int status = status_of_child([&] {
    (void)std::signal(SIGHUP, SIG_IGN);
    (void)std::signal(SIGTERM, [](int) {});
    remove_unfinished_on_signals();
    const UnfinishedName name(folder_ / "file");
    std::ofstream(folder_ / "file") << "half";
    (void)std::raise(SIGHUP);
    (void)std::raise(SIGTERM);
  });
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 9) << status;
  EXPECT_TRUE(fs::exists(folder_ / "file"));
}

TEST_F(UnfinishedNameTest, IsTheParentsOwnWhereAForkedProcessEnds) {
  (void)status_of_child([&] {
    remove_unfinished_on_signals();
    const UnfinishedName name(folder_ / "file");
    std::ofstream(folder_ / "file") << "half";
    (void)status_of_child([] { (void)std::raise(SIGTERM); });
  });
  EXPECT_TRUE(fs::exists(folder_ / "file"));
}

TEST_F(UnfinishedNameTest, HasAPlaceAgainAfterMoreThanCouldBeNoted) {
  std::vector<std::optional<UnfinishedName>> names(40);
  for (auto& name : names) name.emplace(folder_ / "some");
  names.clear();
  (void)status_of_child([&] {
    remove_unfinished_on_signals();
    const UnfinishedName name(folder_ / "file");
    std::ofstream(folder_ / "file") << "half";
    (void)std::raise(SIGINT);
  });
  EXPECT_FALSE(fs::exists(folder_ / "file")) << "the places of those that are over are free again";
}

}  // namespace
}  // namespace earshot::host
