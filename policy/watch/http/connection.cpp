#include "policy/watch/http/connection.hpp"

#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>

#include <array>
#include <cerrno>

#include "policy/watch/http/browser.hpp"

namespace earshot::watch {

using std::chrono::steady_clock;

Connection::Connection(int socket, int stop) : socket_(socket), stop_(stop) {
  constexpr int kOn = 1;
  ::setsockopt(socket_, IPPROTO_TCP, TCP_NODELAY, &kOn, sizeof(kOn));  // a decision waits for no acknowledgement of the one before
  ::setsockopt(socket_, SOL_SOCKET, SO_SNDBUF, &kSendBuffer_bytes, sizeof(kSendBuffer_bytes));
}

Connection::Woken Connection::wait(short events, int other, std::chrono::milliseconds most) const {
  std::array<pollfd, 3> waits{pollfd{socket_, events, 0}, pollfd{stop_, POLLIN, 0}, pollfd{other, POLLIN, 0}};
  const int ready = most.count() <= 0 ? 0 : ::poll(waits.data(), waits.size(), static_cast<int>(most.count()));
  if (ready < 0 && errno == EINTR) return Woken::kReady;
  if (ready < 0 || waits[1].revents != 0) return Woken::kOver;
  if ((waits[0].revents & (POLLERR | POLLHUP | POLLRDHUP | POLLNVAL)) != 0) return Woken::kOver;
  return ready == 0 ? Woken::kSilent : Woken::kReady;
}

bool Connection::send(std::string_view bytes) {
  auto deadline = has_events_ ? steady_clock::now() + kMostStall : began_ + kMostAnswerTime;
  while (!bytes.empty()) {
    const ssize_t count = ::send(socket_, bytes.data(), bytes.size(), MSG_DONTWAIT | MSG_NOSIGNAL);
    if (count > 0) {
      bytes.remove_prefix(static_cast<std::size_t>(count));
      if (has_events_) deadline = steady_clock::now() + kMostStall;
      continue;
    }
    if (count < 0 && errno == EINTR) continue;
    if (count == 0 || errno != EAGAIN) return false;
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - steady_clock::now());
    if (wait(POLLOUT, -1, left) != Woken::kReady) return false;
  }
  return true;
}

bool Connection::send_next(Browser& browser) {
  if (!has_events_) {
    has_events_ = true;
    return send("retry: 1000\n\n");  // ms until a browser that lost the connection comes again
  }
  if (const Frame frame = browser.next()) return send(*frame);
  switch (wait(POLLRDHUP, browser.wake().file_descriptor(), kHeartbeat)) {
    case Woken::kReady:
      return true;
    case Woken::kSilent:
      return send(": nothing new\n\n");
    case Woken::kOver:
      break;
  }
  return false;
}

void Connection::close_in_order() const {
  constexpr std::chrono::seconds kMost{1};
  constexpr std::size_t kMostBytes = std::size_t{1} << 20U;
  const auto deadline = steady_clock::now() + kMost;
  if (::shutdown(socket_, SHUT_WR) != 0) return;
  std::array<char, 4096> bytes{};
  for (std::size_t taken = 0; taken < kMostBytes;) {
    const ssize_t count = ::recv(socket_, bytes.data(), bytes.size(), MSG_DONTWAIT);
    if (count == 0 || (count < 0 && errno != EAGAIN && errno != EINTR)) return;
    if (count > 0) taken += static_cast<std::size_t>(count);
    std::array<pollfd, 2> waits{pollfd{socket_, POLLIN, 0}, pollfd{stop_, POLLIN, 0}};
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - steady_clock::now());
    if (left.count() <= 0 || ::poll(waits.data(), waits.size(), static_cast<int>(left.count())) <= 0 || waits[1].revents != 0) return;
  }
}

std::string Connection::own_address() const {
  sockaddr_storage address{};
  socklen_t size = sizeof(address);
  std::array<char, NI_MAXHOST> name{};
  if (::getsockname(socket_, reinterpret_cast<sockaddr*>(&address), &size) != 0 ||
      ::getnameinfo(reinterpret_cast<sockaddr*>(&address), size, name.data(), name.size(), nullptr, 0, NI_NUMERICHOST) != 0)
    return {};
  const std::string text = name.data();
  constexpr std::string_view kMapped = "::ffff:";  // IPv4 on a socket of both
  return text.starts_with(kMapped) ? text.substr(kMapped.size()) : text;
}

}  // namespace earshot::watch
