#include "sim/link/session.hpp"

#include <dds/dds.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <random>
#include <string_view>

namespace earshot::link {
namespace {

constexpr int kNoSocket = -1;

/// The port that a UDP socket of IPv4 is bound to; kNoSocket for any other descriptor.
int udp_port(int descriptor) {
  int type = 0;
  socklen_t type_size = sizeof(type);
  sockaddr_in address{};
  socklen_t address_size = sizeof(address);
  if (::getsockopt(descriptor, SOL_SOCKET, SO_TYPE, &type, &type_size) != 0 || type != SOCK_DGRAM) return kNoSocket;
  if (::getsockname(descriptor, reinterpret_cast<sockaddr*>(&address), &address_size) != 0) return kNoSocket;
  return address.sin_family == AF_INET ? ntohs(address.sin_port) : kNoSocket;
}

/// Cyclone DDS 0.10 binds the sockets on which it receives to every interface, whatever interface its configuration names
/// (ddsi_udp.c, bind_to_any); here they are bound to `lo`, so that what other hosts send to their ports meets no socket. A program that is
/// started inherits none of them: it would hold the port, and only root may bind a socket a second time.
/// @return how many
int keep_to_loopback(std::uint32_t domain) {
  constexpr std::string_view kLoopback = "lo";
  const int first = static_cast<int>(7400 + 250 * domain);  // DDSI-RTPS 2.2, 9.6.1.1: the ports of a domain
  int sockets = 0;
  for (const auto& entry : std::filesystem::directory_iterator("/proc/self/fd")) {
    const int descriptor = std::stoi(entry.path().filename());
    const int port = udp_port(descriptor);
    if (port < first || port >= first + 250) continue;
    if (::setsockopt(descriptor, SOL_SOCKET, SO_BINDTODEVICE, kLoopback.data(), kLoopback.size()) != 0)
      throw LinkError("simulation link: a socket cannot be bound to the loopback interface: " + std::string(std::strerror(errno)));
    if (::fcntl(descriptor, F_SETFD, FD_CLOEXEC) != 0)
      throw LinkError("simulation link: a socket cannot be kept from other programs: " + std::string(std::strerror(errno)));
    ++sockets;
  }
  return sockets;
}

}  // namespace

RunId new_run() {
  std::random_device random;
  RunId run = 0;
  while (run == 0) run = (RunId{random() >> 1U} << 32U) | random();
  return run;
}

std::string cyclone_configuration() {
  return R"(<CycloneDDS><Domain Id="any">
<General><Interfaces><NetworkInterface name="lo" multicast="false"/></Interfaces><AllowMulticast>false</AllowMulticast></General>
<Discovery><ParticipantIndex>auto</ParticipantIndex><Peers><Peer address="127.0.0.1"/></Peers><LeaseDuration>)" +
         std::to_string(kLeaseSeconds) + R"( s</LeaseDuration><SPDPInterval>100 ms</SPDPInterval></Discovery>
</Domain></CycloneDDS>)";
}

Session::Session(std::uint32_t domain) {
  domain_ = dds_create_domain(domain, cyclone_configuration().c_str());
  if (domain_ < 0) throw LinkError("simulation link: DDS domain " + std::to_string(domain) + ": " + dds_strretcode(domain_));
  try {
    join(domain);
  } catch (...) {
    dds_delete(domain_);
    throw;
  }
}

void Session::join(std::uint32_t domain) {
  if (keep_to_loopback(domain) == 0) throw LinkError("simulation link: Cyclone DDS receives on no port that is known to be its own");
  participant_ = dds_create_participant(domain, nullptr, nullptr);
  if (participant_ < 0)
    throw LinkError("simulation link: DDS participant in domain " + std::to_string(domain) + ": " + dds_strretcode(participant_));
}

Session::~Session() {
  dds_delete(domain_);
}

}  // namespace earshot::link
