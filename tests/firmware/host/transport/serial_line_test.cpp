#include "firmware/host/transport/serial_line.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <stdlib.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <sys/un.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <fstream>
#include <numeric>
#include <string>
#include <thread>
#include <vector>

#include "firmware/host/file/bad_input.hpp"
#include "tests/support/temporary_folder.hpp"

namespace earshot::host {
namespace {

using std::chrono::milliseconds;
constexpr milliseconds kSoon{2000};

std::vector<std::uint8_t> every_byte() {
  std::vector<std::uint8_t> bytes(256);
  std::iota(bytes.begin(), bytes.end(), std::uint8_t{0});
  return bytes;
}

std::vector<std::uint8_t> read_all(int file, std::size_t size) {
  std::vector<std::uint8_t> bytes(size);
  std::size_t at = 0;
  while (at < size) {
    const ssize_t count = ::read(file, bytes.data() + at, size - at);
    if (count <= 0) break;
    at += static_cast<std::size_t>(count);
  }
  bytes.resize(at);
  return bytes;
}

std::vector<std::uint8_t> read_all(SerialLine& line, std::size_t size) {
  std::vector<std::uint8_t> bytes(size);
  std::size_t at = 0;
  while (at < size) {
    const std::size_t count = line.read(std::span(bytes).subspan(at), kSoon);
    if (count == 0) break;
    at += count;
  }
  bytes.resize(at);
  return bytes;
}

std::string refusal(const std::filesystem::path& path, unsigned baud = SerialLine::kBaud) {
  try {
    const SerialLine line(path, baud);
  } catch (const BadInput& e) {
    return e.what();
  }
  return "";
}

/// The other end of a terminal device.
class Terminal {
 public:
  Terminal() {
    if (file_.number() < 0 || ::grantpt(file_.number()) != 0 || ::unlockpt(file_.number()) != 0)
      throw std::runtime_error("no pseudo terminal");
    std::array<char, 64> name{};
    if (::ptsname_r(file_.number(), name.data(), name.size()) != 0) throw std::runtime_error("no name");
    name_ = name.data();
  }
  [[nodiscard]] int number() const { return file_.number(); }
  [[nodiscard]] const std::string& name() const { return name_; }

 private:
  FileDescriptor file_{::posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC)};
  std::string name_;
};

TEST(SerialLine, TakesEveryByteOverATerminalDeviceAsItIs) {
  const Terminal terminal;
  SerialLine line(terminal.name());
  line.write(every_byte(), kSoon);
  EXPECT_EQ(read_all(terminal.number(), 256), every_byte());
  ASSERT_EQ(::write(terminal.number(), every_byte().data(), 256), 256);
  EXPECT_EQ(read_all(line, 256), every_byte());
}

TEST(SerialLine, SpeaksToAnEmulatorsSocketAndNoticesThatItIsGone) {
  const support::TemporaryFolder folder;
  const std::filesystem::path path = folder / "line";
  const FileDescriptor listening(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0));
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  path.string().copy(address.sun_path, sizeof(address.sun_path) - 1);
  ASSERT_EQ(::bind(listening.number(), reinterpret_cast<const sockaddr*>(&address), sizeof(address)), 0);
  ASSERT_EQ(::listen(listening.number(), 1), 0);
  SerialLine line(path);
  std::array<std::uint8_t, 8> room{};
  {
    const FileDescriptor other(::accept(listening.number(), nullptr, nullptr));
    line.write(every_byte(), kSoon);
    EXPECT_EQ(read_all(other.number(), 256), every_byte());
    EXPECT_EQ(line.read(room, milliseconds(1)), 0U) << "nothing came in time";
  }
  EXPECT_THROW((void)line.read(room, kSoon), std::runtime_error);
  EXPECT_THROW(
      {
        for (int i = 0; i < 10; ++i) line.write(every_byte(), kSoon);
      },
      std::runtime_error);
}

TEST(SerialLine, GivesUpWritingToWhoReadsNothing) {
  const Terminal terminal;
  SerialLine line(terminal.name());
  const std::vector<std::uint8_t> much(1'000'000, 7);
  EXPECT_THROW(line.write(much, milliseconds(20)), std::runtime_error);
}

/// Signals that are handled come every 5 ms as long as it lives.
class Signals {
 public:
  Signals() {
    struct sigaction action {};
    action.sa_handler = [](int) {};
    ::sigaction(SIGALRM, &action, &before_);
    every(5'000);
  }
  ~Signals() {
    every(0);
    ::sigaction(SIGALRM, &before_, nullptr);
  }
  Signals(const Signals&) = delete;
  Signals& operator=(const Signals&) = delete;

 private:
  static void every(suseconds_t microseconds) {
    const itimerval time{.it_interval = {.tv_sec = 0, .tv_usec = microseconds}, .it_value = {.tv_sec = 0, .tv_usec = microseconds}};
    ::setitimer(ITIMER_REAL, &time, nullptr);
  }
  struct sigaction before_ {};
};

TEST(SerialLine, WaitsOnThroughSignalsForWhatComesInTime) {
  const Terminal terminal;
  SerialLine line(terminal.name());
  const Signals signals;
  std::array<std::uint8_t, 8> room{};
  std::jthread later([&terminal] {
    std::this_thread::sleep_for(milliseconds(60));
    EXPECT_EQ(::write(terminal.number(), "x", 1), 1);
  });
  EXPECT_EQ(line.read(room, milliseconds(60'000)), 1U);
  EXPECT_EQ(line.read(room, milliseconds(30)), 0U) << "signals do not make it wait for ever";
  const std::vector<std::uint8_t> much(1'000'000, 7);
  EXPECT_THROW(line.write(much, milliseconds(30)), std::runtime_error);
}

TEST(SerialLine, RefusesWhatIsNoLineNamingIt) {
  const support::TemporaryFolder folder;
  EXPECT_NE(refusal(folder / "nothing").find("nothing: No such file"), std::string::npos);
  std::ofstream(folder / "file") << "x";
  EXPECT_NE(refusal(folder / "file").find("file: is no serial line"), std::string::npos);
  EXPECT_NE(refusal(folder / std::string(120, 'x')).find("xxx: "), std::string::npos);
  EXPECT_NE(refusal(Terminal().name() + "none"), "");
  const Terminal terminal;
  EXPECT_NE(refusal(terminal.name(), 12'345).find("no rate of a serial line: 12345"), std::string::npos);
}

}  // namespace
}  // namespace earshot::host
