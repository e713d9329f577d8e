#include "firmware/host/program/live_line.hpp"

#include <gtest/gtest.h>
#include <pty.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <string>
#include <thread>

#include "firmware/host/file/file_descriptor.hpp"
#include "firmware/host/program/progress_bar.hpp"
#include "firmware/host/program/talk.hpp"

namespace earshot::program {
namespace {

/// While it lives, standard error is a terminal of 12 columns.
class Terminal {
 public:
  Terminal() {
    winsize size{.ws_row = 5, .ws_col = 12, .ws_xpixel = 0, .ws_ypixel = 0};
    int master = -1;
    int slave = -1;
    EXPECT_EQ(::openpty(&master, &slave, nullptr, nullptr, &size), 0);
    master_ = host::FileDescriptor(master);
    const host::FileDescriptor end(slave);
    EXPECT_EQ(::dup2(end.number(), STDERR_FILENO), STDERR_FILENO);
  }
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;
  ~Terminal() { (void)::dup2(before_.number(), STDERR_FILENO); }

  /// All that is shown since it was last asked for. A last "|" is written after it, so that nobody waits for what does not come.
  [[nodiscard]] std::string shown() const {
    EXPECT_EQ(::write(STDERR_FILENO, "|", 1), 1);
    std::string text;
    for (std::array<char, 256> piece{}; text.empty() || text.back() != '|';) {
      const ssize_t size = ::read(master_.number(), piece.data(), piece.size());
      if (size <= 0) break;
      text.append(piece.data(), static_cast<std::size_t>(size));
    }
    text.pop_back();
    return text;
  }

 private:
  host::FileDescriptor before_{::dup(STDERR_FILENO)};
  host::FileDescriptor master_;
};

TEST(LiveLine, IsDrawnOverItselfCutToTheTerminalAndErasedAtItsEnd) {
  const Terminal terminal;
  {
    LiveLine line;
    line.draw("reading");
    EXPECT_EQ(terminal.shown(), "\rreading\033[K");
    line.draw("012345678901234");  // 12 columns: the last one stays free
    EXPECT_EQ(terminal.shown(), "\r01234567890\033[K");
  }
  EXPECT_EQ(terminal.shown(), "\r\033[K");
}

TEST(LiveLine, LeavesTheTerminalAloneBeforeASecondIsOverAndWhenNothingWasDrawn) {
  const Terminal terminal;
  {
    const LiveLine line;
    EXPECT_FALSE(line.is_due());
    ProgressBar bar("reading");
    bar.update(0.5);
  }
  EXPECT_EQ(terminal.shown(), "");
}

TEST(ProgressBar, ShowsWhatIsDoneOnceItTakesLongerThanASecond) {
  winsize wide{.ws_row = 5, .ws_col = 80, .ws_xpixel = 0, .ws_ypixel = 0};
  const Terminal terminal;
  EXPECT_EQ(::ioctl(STDERR_FILENO, TIOCSWINSZ, &wide), 0);
  const auto began = std::chrono::steady_clock::now();
  ProgressBar bar("reading");
  std::string shown;
  while (shown.empty()) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    bar.update(0.0);  // how long it will take is not known yet
    EXPECT_EQ(terminal.shown(), "");
    bar.update(0.5);
    shown = terminal.shown();
  }
  // As much time is left as has passed, which is a second and a little.
  EXPECT_EQ(shown.rfind("\rreading [###############...............]  50 %, ", 0), 0U) << shown;
  EXPECT_TRUE(shown.ends_with(" s left\033[K")) << shown;
  const double passed_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  const double left_s = std::stod(shown.substr(shown.find("%, ") + 3));
  EXPECT_GE(left_s, 1.0) << "rounded to a second";
  EXPECT_LE(left_s, passed_s + 0.5);
}

TEST(LiveLine, IsNotThereForWhoWantsQuiet) {
  const Terminal terminal;
  set_talk(Talk::kQuiet);
  {
    LiveLine line;
    line.draw("reading");
  }
  set_talk(Talk::kNormal);
  EXPECT_EQ(terminal.shown(), "");
}

}  // namespace
}  // namespace earshot::program
