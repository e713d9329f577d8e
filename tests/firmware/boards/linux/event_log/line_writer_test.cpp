#include "firmware/boards/linux/event_log/line_writer.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <memory>
#include <string>

#include "firmware/host/file/file_descriptor.hpp"

namespace earshot::board {
namespace {

constexpr std::size_t kPipeBytes = 65'536;  // sixteen pages: the kernel takes a pipe of one for full once a byte is in it

class Pipe {
 public:
  Pipe() {
    std::array<int, 2> ends{};
    EXPECT_EQ(::pipe2(ends.data(), O_CLOEXEC), 0);
    out_ = host::FileDescriptor(ends[0]);
    in_ = host::FileDescriptor(ends[1]);
    EXPECT_EQ(::fcntl(in_.number(), F_SETPIPE_SZ, static_cast<int>(kPipeBytes)), static_cast<int>(kPipeBytes));
  }
  [[nodiscard]] int in() const { return in_.number(); }
  void fill() {
    const std::string much(kPipeBytes, '.');
    EXPECT_EQ(::write(in_.number(), much.data(), much.size()), static_cast<ssize_t>(much.size()));
  }
  /// `count` bytes, waiting for them; fewer at the end.
  std::string read(std::size_t count) {
    std::string text(count, '\0');
    std::size_t got = 0;
    for (ssize_t more = 1; got < count && more > 0; got += static_cast<std::size_t>(more)) {
      more = ::read(out_.number(), text.data() + got, count - got);
      EXPECT_GE(more, 0);
    }
    return text.substr(0, got);
  }
  /// All that was written by writers that are gone.
  std::string rest() {
    in_ = host::FileDescriptor();
    return read(1'000'000);
  }
  void close_reader() { out_ = host::FileDescriptor(); }

 private:
  host::FileDescriptor out_;
  host::FileDescriptor in_;
};

TEST(LineWriter, WritesEveryLineInOrderBeforeItGoes) {
  Pipe pipe;
  {
    LineWriter writer(pipe.in());
    writer.append("one");
    writer.append("two");
    writer.append("");
    writer.append("three");
  }
  EXPECT_EQ(pipe.rest(), "one\ntwo\n\nthree\n");
}

TEST(LineWriter, LetsNobodyWaitForAReaderWhoDoesNotReadAndCountsWhatItLeavesOut) {
  Pipe pipe;
  pipe.fill();
  auto writer = std::make_unique<LineWriter>(pipe.in());
  for (int i = 0; i < 100; ++i) writer->append("line " + std::to_string(i));  // would wait for ever
  EXPECT_EQ(writer->left_out(), 100U - LineWriter::kLines);
  EXPECT_EQ(pipe.read(kPipeBytes), std::string(kPipeBytes, '.'));
  writer.reset();
  std::string kept;
  for (std::size_t i = 0; i < LineWriter::kLines; ++i) kept += "line " + std::to_string(i) + "\n";
  EXPECT_EQ(pipe.rest(), kept);
}

TEST(LineWriter, EndsThoughNobodyReads) {
  Pipe pipe;
  pipe.fill();
  {
    LineWriter writer(pipe.in());
    writer.append("never read");
  }
  EXPECT_EQ(pipe.rest(), std::string(kPipeBytes, '.'));
}

TEST(LineWriter, EndsNoProcessWhoseReaderIsGone) {
  Pipe pipe;
  pipe.close_reader();
  LineWriter writer(pipe.in());
  writer.append("to nobody");
}

TEST(LineWriter, CutsALineThatIsLongerThanItsRoom) {
  Pipe pipe;
  { LineWriter(pipe.in()).append(std::string(1000, 'x')); }
  EXPECT_EQ(pipe.rest(), std::string(LineWriter::kLineBytes - 1, 'x') + "\n");
}

}  // namespace
}  // namespace earshot::board
