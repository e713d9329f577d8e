#include "hil/bus/serial/serial_adapter.hpp"

#include <fcntl.h>
#include <net/if.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <system_error>

#include "hil/bus/interface_switch.hpp"
#include "hil/bus/serial/slcan_line.hpp"

namespace earshot::hil {
namespace {

using State = n2k::ControllerState;

constexpr int kSerialCan = 17;  // N_SLCAN of linux/tty.h
constexpr std::size_t kMostUnwritten = 64 * 1024;

void check(bool is_done, const char* call) {
  if (!is_done) throw std::system_error(errno, std::generic_category(), std::string("a pseudo-terminal: ") + call);
}

host::FileDescriptor open_far_end() {
  host::FileDescriptor end(::posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC));
  check(end.number() >= 0 && ::grantpt(end.number()) == 0 && ::unlockpt(end.number()) == 0, "posix_openpt");
  check(::fcntl(end.number(), F_SETFL, O_NONBLOCK) == 0, "fcntl");
  return end;
}

host::FileDescriptor open_near_end(const host::FileDescriptor& far_end) {
  std::array<char, 64> name{};
  check(::ptsname_r(far_end.number(), name.data(), name.size()) == 0, "ptsname_r");
  host::FileDescriptor end(::open(name.data(), O_RDWR | O_NOCTTY | O_CLOEXEC));
  check(end.number() >= 0, "open");
  termios settings{};
  check(::tcgetattr(end.number(), &settings) == 0, "tcgetattr");
  ::cfmakeraw(&settings);
  check(::tcsetattr(end.number(), TCSANOW, &settings) == 0, "tcsetattr");
  return end;
}

/// @return its name
std::string make_interface(const host::FileDescriptor& near_end) {
  ifreq request{};
  if (::ioctl(near_end.number(), TIOCSETD, &kSerialCan) != 0)
    throw NoSerialCan(errno == EPERM ? "only root may make a CAN interface of a serial line" : "the kernel has no slcan");
  check(::ioctl(near_end.number(), SIOCGIFNAME, &request) == 0, "SIOCGIFNAME");
  return {request.ifr_name, ::strnlen(request.ifr_name, sizeof request.ifr_name)};
}

}  // namespace

SerialAdapter::SerialAdapter(const std::string& bus)
    : far_end_(open_far_end()),
      near_end_(open_near_end(far_end_)),
      interface_(make_interface(near_end_)),
      bus_(bus),
      thread_([this](const std::stop_token& stop) { relay(stop); }) {
  switch_interface(interface_, true);  // by lines that the thread reads
}

SerialAdapter::~SerialAdapter() {
  thread_.request_stop();
  wake_event_.signal();
}

void SerialAdapter::become(State state) {
  const bool comes_back = state_.exchange(state) == State::kBusOff && state != State::kBusOff;
  wake_event_.signal();
  if (!comes_back) return;
  switch_interface(interface_, false);
  switch_interface(interface_, true);
}

void SerialAdapter::relay(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    std::array<pollfd, 3> ready{pollfd{.fd = far_end_.number(), .events = POLLIN, .revents = 0},
                                pollfd{.fd = bus_.file_descriptor(), .events = POLLIN, .revents = 0},
                                pollfd{.fd = wake_event_.file_descriptor(), .events = POLLIN, .revents = 0}};
    if (!unwritten_.empty()) ready[0].events |= POLLOUT;
    (void)::poll(ready.data(), ready.size(), -1);
    wake_event_.clear();
    report_state();
    pass_to_bus();
    pass_to_line();
    write_line();
  }
}

/// The kernel's interface comes back from bus-off as new, and needs no telling.
void SerialAdapter::report_state() {
  const State state = state_;
  if (state == reported_) return;
  if (reported_ != State::kBusOff || state != State::kErrorActive) unwritten_ += to_line(state);
  reported_ = state;
}

void SerialAdapter::pass_to_bus() {
  std::array<char, 4096> bytes{};
  for (ssize_t size = 0; (size = ::read(far_end_.number(), bytes.data(), bytes.size())) > 0;)
    received_.append(bytes.data(), static_cast<std::size_t>(size));
  std::size_t begin = 0;
  for (std::size_t end = 0; (end = received_.find('\r', begin)) != std::string::npos; begin = end + 1)
    take_line(std::string_view(received_).substr(begin, end - begin));
  received_.erase(0, begin);
}

/// Commands (bit rate, open, close) need nothing done.
void SerialAdapter::take_line(std::string_view line) {
  const std::optional<n2k::Frame> frame = read_line(line);
  if (!frame) return;
  const bool is_passed = reported_ != State::kBusOff && bus_.send(*frame) == Status::kOk;
  ++(is_passed ? passed_ : refused_);
}

void SerialAdapter::pass_to_line() {
  for (n2k::Frame frame; bus_.receive(frame) == Status::kOk;) {
    const bool is_passed = reported_ != State::kBusOff && unwritten_.size() < kMostUnwritten;
    if (is_passed) unwritten_ += to_line(frame);
    ++(is_passed ? passed_ : refused_);
  }
}

void SerialAdapter::write_line() {
  if (unwritten_.empty()) return;
  const ssize_t size = ::write(far_end_.number(), unwritten_.data(), unwritten_.size());
  if (size > 0) unwritten_.erase(0, static_cast<std::size_t>(size));
}

}  // namespace earshot::hil
