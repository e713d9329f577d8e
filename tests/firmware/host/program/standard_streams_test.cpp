#include "firmware/host/program/standard_streams.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <optional>
#include <ostream>
#include <sstream>
#include <string>

#include "firmware/host/file/file_descriptor.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot::program {
namespace {

class NonBlockingStreamTest : public testing::Test {
 protected:
  NonBlockingStreamTest() {
    std::array<int, 2> ends{};
    EXPECT_EQ(::pipe2(ends.data(), O_CLOEXEC), 0);
    out_ = host::FileDescriptor(ends[0]);
    in_ = host::FileDescriptor(ends[1]);
    patient_.emplace(stream_, in_.number());
  }
  [[nodiscard]] std::string read() const {
    std::string text(200'000, '\0');
    const ssize_t count = ::read(out_.number(), text.data(), text.size());
    return text.substr(0, static_cast<std::size_t>(count));
  }
  void fill() const {
    const std::string dots(4096, '.');
    EXPECT_EQ(::fcntl(in_.number(), F_SETFL, O_NONBLOCK), 0);
    while (::write(in_.number(), dots.data(), dots.size()) > 0) {
    }
    EXPECT_EQ(::fcntl(in_.number(), F_SETFL, 0), 0);
  }

  host::FileDescriptor out_;
  host::FileDescriptor in_;
  std::ostringstream before_;
  std::ostream stream_{before_.rdbuf()};
  std::optional<NonBlockingStream> patient_;
};

TEST_F(NonBlockingStreamTest, SaysEachLineAtOnceAndTheRestWhenItIsToldToOrGoes) {
  stream_ << "one" << 1 << "\ntwo";
  EXPECT_EQ(read(), "one1\n");
  stream_ << std::flush;
  EXPECT_EQ(read(), "two");
  stream_ << "three";
  patient_.reset();
  EXPECT_EQ(read(), "three");
  stream_ << "as before";
  EXPECT_EQ(before_.str(), "as before");
}

TEST_F(NonBlockingStreamTest, SaysNoPartOfALineThoughItsStreamWouldHaveSaidEveryWord) {
  patient_.reset();
  stream_ << std::unitbuf;  // as standard error does
  patient_.emplace(stream_, in_.number());
  stream_ << "one" << 1;
  pollfd waiting{.fd = out_.number(), .events = POLLIN, .revents = 0};
  EXPECT_EQ(::poll(&waiting, 1, 0), 0);
  stream_ << "\n";
  EXPECT_EQ(read(), "one1\n");
}

TEST_F(NonBlockingStreamTest, SaysAllOfALineThatIsLongerThanAPipeTakesAtOnce) {
  const std::string line = std::string(10'000, 'x') + "\n";
  stream_ << line;
  EXPECT_EQ(read(), line);
}

TEST_F(NonBlockingStreamTest, LeavesOutWhatNobodyReadsAndSaysSoToWhoReadsAgain) {
  fill();
  stream_ << "never read\nnor this\n";  // would wait for ever
  EXPECT_TRUE(stream_.good());
  (void)read();
  stream_ << "read again\n";
  EXPECT_TRUE(support::lines_tell(read(), {{"2 lines", "here", "nobody"}, {"read", "again"}}));
}

TEST_F(NonBlockingStreamTest, SaysThatOneLineIsLeftOut) {
  fill();
  stream_ << "never read\n";
  (void)read();
  stream_ << "!" << std::flush;  // as little as there is
  EXPECT_TRUE(stream_.good());
  EXPECT_TRUE(support::lines_tell(read(), {{"1 lines", "nobody"}, {"!"}}));
}

TEST_F(NonBlockingStreamTest, FailsWhenItsReaderIsGoneBeforeItCouldSayWhatIsLeftOut) {
  (void)std::signal(SIGPIPE, SIG_IGN);
  fill();
  stream_ << "never read\n";
  out_ = host::FileDescriptor();
  stream_ << "nor this" << std::flush;
  EXPECT_FALSE(stream_.good());
}

TEST_F(NonBlockingStreamTest, SaysALineOnceWhateverWasInterruptedBefore) {
  errno = EINTR;
  stream_ << "once\n";
  in_ = host::FileDescriptor();
  EXPECT_EQ(read(), "once\n");
}

TEST_F(NonBlockingStreamTest, LeavesItsStreamAsItWas) {
  std::ostringstream sink;
  std::ostream stream(sink.rdbuf());
  stream << std::unitbuf;
  { const NonBlockingStream patient(stream, in_.number()); }
  EXPECT_NE(stream.flags() & std::ios::unitbuf, 0);
  EXPECT_EQ(stream.rdbuf(), sink.rdbuf());
}

TEST(OpenStandardStreams, OpensNothingWhenAllAreThere) {
  const host::FileDescriptor before(::open("/dev/null", O_RDONLY | O_CLOEXEC));
  open_standard_streams();
  const host::FileDescriptor after(::open("/dev/null", O_RDONLY | O_CLOEXEC));
  EXPECT_EQ(after.number(), before.number() + 1);
}

TEST(OpenStandardStreams, LeavesNoClosedOneForAFileOfTheProgramsOwn) {
  const auto close_then_open = [] {
    (void)::close(STDIN_FILENO);
    (void)::close(STDOUT_FILENO);
    open_standard_streams();
    const bool is_read_only = (::fcntl(STDOUT_FILENO, F_GETFL) & O_ACCMODE) == O_RDONLY;
    const bool is_taken = ::open("/dev/null", O_WRONLY) > STDERR_FILENO;
    std::exit(is_read_only && is_taken && ::write(STDOUT_FILENO, "!", 1) < 0 ? 0 : 1);
  };
  EXPECT_EXIT(close_then_open(), testing::ExitedWithCode(0), "");
}

TEST_F(NonBlockingStreamTest, FailsWhenItsReaderIsGone) {
  (void)std::signal(SIGPIPE, SIG_IGN);
  out_ = host::FileDescriptor();
  stream_ << "to nobody\n";
  EXPECT_FALSE(stream_.good());
}

}  // namespace
}  // namespace earshot::program
