#include "firmware/host/transport/serial_line.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <string>

#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/file/printable.hpp"

namespace earshot::host {
namespace {

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& why) {
  throw BadInput(printable(path.string()) + ": " + why);
}

std::string of_error() {
  return std::strerror(errno);  // NOLINT(concurrency-mt-unsafe): before any other thread
}

FileDescriptor connect_to(const std::filesystem::path& path) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  const std::string name = path.string();
  if (name.size() >= sizeof(address.sun_path)) refuse(path, "the path of a socket has at most 107 bytes");
  name.copy(address.sun_path, name.size());
  FileDescriptor file(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  if (file.number() < 0 || ::connect(file.number(), reinterpret_cast<const sockaddr*>(&address), sizeof(address)) != 0)
    refuse(path, of_error());
  return file;
}

speed_t speed_of(unsigned baud, const std::filesystem::path& path) {
  switch (baud) {
    case 115'200:
      return B115200;
    case 1'000'000:
      return B1000000;
    default:
      refuse(path, "no rate of a serial line: " + std::to_string(baud));
  }
}

FileDescriptor open_device(const std::filesystem::path& path, unsigned baud) {
  FileDescriptor file(::open(path.c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC | O_NONBLOCK));
  termios settings{};
  if (file.number() < 0) refuse(path, of_error());
  if (::tcgetattr(file.number(), &settings) != 0) refuse(path, "is no serial line (a terminal device, or a Unix socket)");
  ::cfmakeraw(&settings);
  const speed_t speed = speed_of(baud, path);
  ::cfsetispeed(&settings, speed);
  ::cfsetospeed(&settings, speed);
  if (::tcsetattr(file.number(), TCSANOW, &settings) != 0) refuse(path, of_error());
  return file;
}

bool leads_to_socket(const std::filesystem::path& path) {
  struct stat found {};
  if (::stat(path.c_str(), &found) != 0) refuse(path, of_error());
  return S_ISSOCK(found.st_mode);
}

/// Whether the line can be read, or written, in time. A signal that this process handles meanwhile takes none of it.
bool wait_for(int file, short event, std::chrono::milliseconds patience) {
  const auto end = std::chrono::steady_clock::now() + patience;
  pollfd waiting{.fd = file, .events = event, .revents = 0};
  for (;;) {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(end - std::chrono::steady_clock::now());
    const int ready = ::poll(&waiting, 1, static_cast<int>(std::max<std::int64_t>(left.count(), 0)));
    if (ready >= 0 || errno != EINTR) return ready > 0;
  }
}

}  // namespace

SerialLine::SerialLine(const std::filesystem::path& path, unsigned baud)
    : path_(path), is_socket_(leads_to_socket(path)), file_(is_socket_ ? connect_to(path) : open_device(path, baud)) {}

std::size_t SerialLine::read(std::span<std::uint8_t> bytes, std::chrono::milliseconds patience) {
  if (!wait_for(file_.number(), POLLIN, patience)) return 0;
  const ssize_t count = ::read(file_.number(), bytes.data(), bytes.size());
  if (count > 0) return static_cast<std::size_t>(count);
  if (count < 0 && (errno == EAGAIN || errno == EINTR)) return 0;
  throw std::runtime_error(printable(path_.string()) + ": the serial line is gone");
}

void SerialLine::write(std::span<const std::uint8_t> bytes, std::chrono::milliseconds patience) {
  while (!bytes.empty()) {
    // A socket whose other end is gone would end the process with a signal.
    const ssize_t count =
        is_socket_ ? ::send(file_.number(), bytes.data(), bytes.size(), MSG_NOSIGNAL) : ::write(file_.number(), bytes.data(), bytes.size());
    if (count > 0) {
      bytes = bytes.subspan(static_cast<std::size_t>(count));
    } else if (count < 0 && errno == EINTR) {
      continue;
    } else if (count < 0 && errno != EAGAIN) {
      throw std::runtime_error(printable(path_.string()) + ": the serial line is gone");
    } else if (!wait_for(file_.number(), POLLOUT, patience)) {
      throw std::runtime_error(printable(path_.string()) + ": the serial line takes nothing more");
    }
  }
}

}  // namespace earshot::host
