// What must not end a vehicle at sea, or keep it from its loop: a slip of the keys, and who reads its words.

#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "firmware/boards/linux/replay/replay.hpp"
#include "firmware/host/file/file_descriptor.hpp"
#include "tests/scenario/walk_at_sea.hpp"
#include "tests/support/private_network.hpp"
#include "tests/support/process.hpp"

namespace earshot {
namespace {

using namespace std::chrono_literals;
namespace fs = std::filesystem;

class Accidents : public WalkAtSea {
 protected:
  void SetUp() override {
    ENTER_PRIVATE_NETWORK_OR_SKIP();
    write_mission(mission_of_short_steps("search.toml"));
  }

  void start_earshotd_writing_to(const std::string& folder) {
    const std::vector<std::string> a{
        folder_ / "mission.toml", "--policy", folder_ / "walk.policy", "--public-key", folder_ / "walk.pub", "--out", folder};
    earshotd_ = std::make_unique<support::Process>(fs::path(EARSHOT_BIN_DIR) / "earshotd", a, folder_ / "earshotd.txt");
  }

  /// Standard output and error of the program that is started next go into a pipe.
  [[nodiscard]] host::FileDescriptor reader_of_its_words(int flags) const {
    const fs::path pipe = folder_ / "earshotd.txt";
    EXPECT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    return host::FileDescriptor(::open(pipe.c_str(), flags | O_NONBLOCK | O_CLOEXEC));
  }

  /// Until the journal has its first records: next is the loop.
  [[nodiscard]] bool has_begun() const {
    for (const auto deadline = std::chrono::steady_clock::now() + 20s; std::chrono::steady_clock::now() < deadline;) {
      std::error_code error;
      if (const auto size = fs::file_size(folder_ / "journal.lcmlog", error); !error && size > 0) return true;
      std::this_thread::sleep_for(10ms);
    }
    return false;
  }

  /// Until its journal has grown three times: it makes turns.
  [[nodiscard]] bool goes_on() const {
    int times = 0;
    auto size = journal_bytes();
    for (const auto deadline = std::chrono::steady_clock::now() + 20s; times < 3 && std::chrono::steady_clock::now() < deadline;) {
      std::this_thread::sleep_for(10ms);
      const auto now = journal_bytes();
      if (now > size) ++times;
      size = now;
    }
    return times == 3;
  }
  /// Of all its parts.
  [[nodiscard]] std::uintmax_t journal_bytes() const {
    std::uintmax_t bytes = 0;
    std::error_code error;
    for (const auto& file : fs::directory_iterator(folder_)) {
      if (file.path().extension() == ".lcmlog") bytes += fs::file_size(file, error);
    }
    return bytes;
  }

  /// Until it is in its loop, in which it tells its state. @return what it has said
  [[nodiscard]] std::string words_up_to_its_loop() const {
    std::string words;
    for (int i = 0; i < 2000 && words.find("UTC: STANDBY") == std::string::npos; ++i) {
      words = earshotd_->output();
      std::this_thread::sleep_for(10ms);
    }
    return words;
  }
};

TEST_F(Accidents, GivenSignalsThatNobodyMeansItGoesOnAndQuitEndsItInOrder) {
  start_earshotd({});
  ASSERT_NE(words_up_to_its_loop().find("STANDBY"), std::string::npos) << earshotd_->output();
  for (const int number : {SIGHUP, SIGUSR1, SIGUSR2, SIGALRM, SIGTSTP, SIGIO, SIGRTMIN}) earshotd_->signal(number);
  EXPECT_TRUE(goes_on()) << "it ended";
  earshotd_->signal(SIGQUIT);
  EXPECT_EQ(earshotd_->wait(5s), 0) << earshotd_->output();
  EXPECT_NE(earshotd_->output().find("in STANDBY; it ended in ABORT"), std::string::npos) << earshotd_->output();
}

TEST_F(Accidents, GivenAHangUpItBeginsAnotherPartOfItsJournalWhichReplaysWithTheFirstAsOne) {
  start_earshotd({});
  ASSERT_NE(words_up_to_its_loop().find("STANDBY"), std::string::npos) << earshotd_->output();
  ASSERT_TRUE(goes_on());
  earshotd_->signal(SIGHUP);
  for (int i = 0; i < 1000 && !fs::exists(folder_ / "journal.part2.lcmlog"); ++i) std::this_thread::sleep_for(10ms);
  ASSERT_TRUE(fs::exists(folder_ / "journal.part2.lcmlog")) << earshotd_->output();
  ASSERT_TRUE(goes_on());
  earshotd_->signal(SIGTERM);
  EXPECT_EQ(earshotd_->wait(5s), 0) << earshotd_->output();
  const board::ReplayResult replayed = board::replay(folder_ / "journal.lcmlog");
  EXPECT_TRUE(replayed.is_same());
  EXPECT_TRUE(replayed.closing) << "it stands in the second part";
  EXPECT_GT(replayed.turns, 6U);
}

TEST_F(Accidents, GivenABudgetItDeletesTheJournalOfAnEarlierFlightAndSaysWhich) {
  std::ofstream(folder_ / "journal.lcmlog", std::ios::binary) << "\xED\xA1\xDA\x01" << std::string(1'500'000, 'x');
  start_earshotd({"--journal-budget-mb", "1"});
  ASSERT_NE(words_up_to_its_loop().find("STANDBY"), std::string::npos) << earshotd_->output();
  ASSERT_TRUE(goes_on());
  earshotd_->signal(SIGTERM);
  EXPECT_EQ(earshotd_->wait(5s), 0) << earshotd_->output();
  EXPECT_FALSE(fs::exists(folder_ / "journal.lcmlog"));
  EXPECT_TRUE(board::replay(folder_ / "journal-2.lcmlog").closing);
  const std::string told = " deleted to stay within --journal-budget-mb, up to " + (folder_ / "journal.lcmlog").string() + "\n";
  EXPECT_NE(earshotd_->output().find(told), std::string::npos) << earshotd_->output();
}

TEST_F(Accidents, GivenItsReaderGoesAwayItFliesOnAndEndsInOrder) {
  host::FileDescriptor reader = reader_of_its_words(O_RDONLY);
  start_earshotd({});
  pollfd words{.fd = reader.number(), .events = POLLIN, .revents = 0};
  ASSERT_EQ(::poll(&words, 1, 20'000), 1);
  reader = host::FileDescriptor();
  ASSERT_TRUE(has_begun());
  EXPECT_TRUE(goes_on()) << "it ended";
  earshotd_->signal(SIGTERM);
  EXPECT_EQ(earshotd_->wait(5s), 0);
}

TEST_F(Accidents, GivenAFullPipeThatNobodyReadsItFliesAllTheSameAndEndsInOrder) {
  const host::FileDescriptor reader = reader_of_its_words(O_RDWR);
  const std::string much(4096, '.');
  while (::write(reader.number(), much.data(), much.size()) > 0) {
  }
  start_earshotd({});
  ASSERT_TRUE(has_begun());
  earshotd_->signal(SIGTERM);
  EXPECT_EQ(earshotd_->wait(10s), 0);
}

TEST_F(Accidents, GivenClosedStandardStreamsItsWordsGoIntoNoneOfItsOwnFiles) {
  const std::vector<std::string> a{"-c",
                                   "exec \"$@\" <&- >&- 2>&-",
                                   "bash",
                                   fs::path(EARSHOT_BIN_DIR) / "earshotd",
                                   folder_ / "mission.toml",
                                   "--policy",
                                   folder_ / "walk.policy",
                                   "--public-key",
                                   folder_ / "walk.pub",
                                   "--out",
                                   folder_.path()};
  support::Process runtime("/bin/bash", a, folder_ / "text");
  ASSERT_TRUE(has_begun());
  for (const char* number : {"0", "1", "2"})
    EXPECT_EQ(fs::read_symlink(fs::path("/proc") / std::to_string(runtime.pid()) / "fd" / number), "/dev/null") << number;
  runtime.signal(SIGTERM);
  EXPECT_EQ(runtime.wait(5s), 0);
}

TEST_F(Accidents, GivenAFolderWhoseNameWouldSteerATerminalItsWordsSpellItOut) {
  start_earshotd_writing_to(folder_ / "a\x1b[31m");
  const std::string words = words_up_to_its_loop();
  EXPECT_NE(words.find("a\\x1b[31m/journal.lcmlog\n"), std::string::npos) << words;
  earshotd_->signal(SIGTERM);
  EXPECT_EQ(earshotd_->wait(5s), 0);
  EXPECT_EQ(earshotd_->output().find('\x1b'), std::string::npos) << earshotd_->output();
}

TEST_F(Accidents, GivenNoNameOfAFolderItSaysWhichOptionLacksIt) {
  start_earshotd_writing_to("");
  EXPECT_EQ(earshotd_->wait(5s), 2);
  EXPECT_NE(earshotd_->output().find("--out: names no folder"), std::string::npos) << earshotd_->output();
}

}  // namespace
}  // namespace earshot
