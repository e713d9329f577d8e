#include "hil/bench/lcm/network.hpp"

#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>

#include <cerrno>
#include <string>
#include <system_error>
#include <utility>

namespace earshot::hil {
namespace {

constexpr int kComesRound_ms = 2000;

void check(int result, const char* call) {
  if (result < 0) throw std::system_error(errno, std::generic_category(), std::string("the bench's LCM: ") + call);
}

host::FileDescriptor open_udp() {
  host::FileDescriptor socket(::socket(AF_INET, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
  check(socket.number(), "socket");
  return socket;
}

template <class Value>
void set(const host::FileDescriptor& socket, int level, int name, const Value& value, const char* what) {
  check(::setsockopt(socket.number(), level, name, &value, sizeof value), what);
}

const sockaddr* generic(const sockaddr_in& address) {
  return reinterpret_cast<const sockaddr*>(&address);
}

sockaddr_in address_of(const host::LcmUrl& url) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(url.group);
  address.sin_port = htons(url.port);
  return address;
}

host::FileDescriptor open_sender(const host::LcmUrl& url) {
  host::FileDescriptor socket = open_udp();
  in_addr loopback{};
  loopback.s_addr = htonl(INADDR_LOOPBACK);
  set(socket, IPPROTO_IP, IP_MULTICAST_IF, loopback, "IP_MULTICAST_IF");
  set(socket, IPPROTO_IP, IP_MULTICAST_TTL, 0, "IP_MULTICAST_TTL");
  set(socket, IPPROTO_IP, IP_MULTICAST_LOOP, 1, "IP_MULTICAST_LOOP");
  const sockaddr_in address = address_of(url);
  check(::connect(socket.number(), generic(address), sizeof address), "connect");
  return socket;
}

host::FileDescriptor open_receiver(const host::LcmUrl& url) {
  host::FileDescriptor socket = open_udp();
  set(socket, SOL_SOCKET, SO_REUSEADDR, 1, "SO_REUSEADDR");
  set(socket, IPPROTO_IP, IP_MULTICAST_ALL, 0, "IP_MULTICAST_ALL");
  const sockaddr_in address = address_of(url);
  check(::bind(socket.number(), generic(address), sizeof address), "bind");
  ip_mreqn group{};
  group.imr_multiaddr.s_addr = htonl(url.group);
  group.imr_address.s_addr = htonl(INADDR_LOOPBACK);
  set(socket, IPPROTO_IP, IP_ADD_MEMBERSHIP, group, "IP_ADD_MEMBERSHIP");
  return socket;
}

wire::Sender sender_of(const sockaddr_in& address) {
  return {.address = address.sin_addr.s_addr, .port = address.sin_port};
}

}  // namespace

Network::Network(const host::LcmUrl& url) : sender_(open_sender(url)), receiver_(open_receiver(url)) {
  sockaddr_in own{};
  socklen_t size = sizeof own;
  check(::getsockname(sender_.number(), reinterpret_cast<sockaddr*>(&own), &size), "getsockname");
  self_ = sender_of(own);
}

bool Network::send(std::span<const std::uint8_t> datagram) {
  if (::send(sender_.number(), datagram.data(), datagram.size(), 0) < 0) return false;
  for (;;) {
    std::optional<Arrival> arrival = next(kComesRound_ms);
    if (!arrival) return false;
    if (arrival->from == self_) return true;
    waiting_.push_back(std::move(*arrival));
  }
}

std::optional<LcmMessage> Network::receive(int most_ms) {
  for (;;) {
    std::optional<Arrival> arrival;
    if (waiting_.empty()) {
      arrival = next(most_ms);
    } else {
      arrival = std::move(waiting_.front());
      waiting_.pop_front();
    }
    if (!arrival) return std::nullopt;
    wire::Lc02Message message;
    if (arrival->from == self_ || reassembly_->accept(arrival->datagram, arrival->from, message) != Status::kOk) continue;
    return LcmMessage{.channel = std::string(message.channel), .data = {message.data.begin(), message.data.end()}};
  }
}

std::optional<Network::Arrival> Network::next(int most_ms) {
  pollfd readable{.fd = receiver_.number(), .events = POLLIN, .revents = 0};
  if (::poll(&readable, 1, most_ms) <= 0) return std::nullopt;
  Arrival arrival{.from = {}, .datagram = std::vector<std::uint8_t>(wire::kMaxDatagram)};
  sockaddr_in from{};
  socklen_t from_size = sizeof from;
  const ssize_t size =
      ::recvfrom(receiver_.number(), arrival.datagram.data(), arrival.datagram.size(), 0, reinterpret_cast<sockaddr*>(&from), &from_size);
  if (size < 0) return std::nullopt;
  arrival.datagram.resize(static_cast<std::size_t>(size));
  arrival.from = sender_of(from);
  return arrival;
}

}  // namespace earshot::hil
