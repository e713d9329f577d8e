// What an endpoint puts on the network and lets in, seen by plain sockets.
#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <net/if.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/uio.h>

#include <array>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <stdexcept>
#include <string>
#include <system_error>
#include <vector>

#include "firmware/host/transport/lcm_endpoint.hpp"
#include "tests/support/private_network.hpp"

namespace earshot::host {
namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr const char* kGroup = "239.255.76.67";
constexpr std::uint16_t kLcmPort = 7667;
constexpr const char* kHere = "udpm://239.255.76.67:7667?ttl=0";
constexpr const char* kOneHop = "udpm://239.255.76.67:7667?ttl=1";
constexpr int kPatience_ms = 5000;  // only a failing test waits so long

sockaddr_in address_of(const char* address, std::uint16_t port) {
  sockaddr_in full{};
  full.sin_family = AF_INET;
  full.sin_addr.s_addr = ::inet_addr(address);
  full.sin_port = htons(port);
  return full;
}

/// A UDP socket of the test's.
class Udp {
 public:
  Udp() : socket_(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0)) { set(SOL_SOCKET, SO_REUSEADDR, 1); }

  template <class Value>
  void set(int level, int name, const Value& value) const {
    EXPECT_EQ(::setsockopt(socket_.number(), level, name, &value, sizeof value), 0) << name << ": " << std::strerror(errno);
  }
  void bind_to(const char* address, std::uint16_t port) const {
    const sockaddr_in full = address_of(address, port);
    ASSERT_EQ(::bind(socket_.number(), reinterpret_cast<const sockaddr*>(&full), sizeof full), 0) << std::strerror(errno);
  }
  [[nodiscard]] static ip_mreqn on(const char* interface) {
    ip_mreqn request{};
    request.imr_multiaddr.s_addr = ::inet_addr(kGroup);
    request.imr_ifindex = static_cast<int>(::if_nametoindex(interface));
    return request;
  }
  void send(const Bytes& datagram) const {
    const sockaddr_in group = address_of(kGroup, kLcmPort);
    EXPECT_GE(::sendto(socket_.number(), datagram.data(), datagram.size(), 0, reinterpret_cast<const sockaddr*>(&group), sizeof group), 0)
        << std::strerror(errno);
  }
  [[nodiscard]] int number() const { return socket_.number(); }

 private:
  FileDescriptor socket_;
};

/// Hears the group on one interface, and how each datagram came.
class Witness {
 public:
  explicit Witness(const char* interface) {
    socket_.bind_to(kGroup, kLcmPort);
    socket_.set(IPPROTO_IP, IP_ADD_MEMBERSHIP, Udp::on(interface));
    socket_.set(IPPROTO_IP, IP_MULTICAST_ALL, 0);
    socket_.set(IPPROTO_IP, IP_RECVTTL, 1);
  }

  struct Seen {
    Bytes bytes;
    std::string from;
    int time_to_live = -1;
    /// Big-endian, as everything in LCM.
    [[nodiscard]] std::uint32_t number_at(std::size_t i) const {
      return std::uint32_t{bytes.at(i)} << 24U | std::uint32_t{bytes.at(i + 1)} << 16U | std::uint32_t{bytes.at(i + 2)} << 8U |
             bytes.at(i + 3);
    }
  };
  /// @return none when none comes
  [[nodiscard]] std::optional<Seen> next(int patience_ms = kPatience_ms) const {
    pollfd ready{socket_.number(), POLLIN, 0};
    if (::poll(&ready, 1, patience_ms) != 1) return std::nullopt;
    Seen seen{.bytes = Bytes(65'536), .from = {}};
    sockaddr_in from{};
    iovec piece{seen.bytes.data(), seen.bytes.size()};
    alignas(cmsghdr) std::array<char, 64> control{};
    msghdr header{.msg_name = &from,
                  .msg_namelen = sizeof from,
                  .msg_iov = &piece,
                  .msg_iovlen = 1,
                  .msg_control = control.data(),
                  .msg_controllen = control.size(),
                  .msg_flags = 0};
    const ssize_t size = ::recvmsg(socket_.number(), &header, 0);
    if (size < 0) return std::nullopt;
    seen.bytes.resize(static_cast<std::size_t>(size));
    seen.from = ::inet_ntoa(from.sin_addr);
    for (cmsghdr* c = CMSG_FIRSTHDR(&header); c != nullptr; c = CMSG_NXTHDR(&header, c)) {
      if (c->cmsg_level == IPPROTO_IP && c->cmsg_type == IP_TTL) std::memcpy(&seen.time_to_live, CMSG_DATA(c), sizeof(int));
    }
    return seen;
  }

 private:
  Udp socket_;
};

/// LC02, number 0, channel "EARSHOT_A", one byte.
const Bytes kMessage{'L', 'C', '0', '2', 0, 0, 0, 0, 'E', 'A', 'R', 'S', 'H', 'O', 'T', '_', 'A', 0, 1};

void run(const std::string& commands) {
  ASSERT_EQ(std::system(("PATH=/usr/sbin:/usr/bin:/sbin:/bin; " + commands).c_str()), 0) << commands;
}

/// On a host of its own: loopback, and an Ethernet interface to which every route leads.
class OnTheWire : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    isolated_ = test::enter_private_network();
    ASSERT_TRUE(isolated_ || test::may_do_without_private_network()) << test::kNoPrivateNetwork;
    if (!isolated_) return;
    run("ip link add eth0 type veth peer name far0 && ip addr add 10.9.8.7/24 dev eth0 && ip link set eth0 up && ip link set far0 up &&"
        " ip route del 224.0.0.0/4 dev lo && ip route add default dev eth0");
  }
  void SetUp() override {
    if (!isolated_) GTEST_SKIP() << test::kOnlyRootMayHavePrivateNetwork;
  }

  /// What has come, and nothing else: the message on EARSHOT_A.
  static bool hears_message(LcmEndpoint& endpoint) {
    pollfd ready{endpoint.file_descriptor(), POLLIN, 0};
    (void)::poll(&ready, 1, kPatience_ms);
    endpoint.collect();
    wire::Lc02Message message;
    return endpoint.take(message) == Status::kOk && message.channel == "EARSHOT_A";
  }

  static inline bool isolated_ = false;
};

TEST_F(OnTheWire, NumbersItsMessagesOneAfterTheOtherAndAllPiecesOfOneAlike) {
  const Witness witness("lo");
  LcmEndpoint endpoint(parse_lcm_url(kHere), {});
  ASSERT_EQ(endpoint.publish("EARSHOT_A", Bytes{1}), Status::kOk);
  EXPECT_EQ(endpoint.publish("", Bytes{1}), Status::kOutOfRange) << "what is not sent has no number";
  ASSERT_EQ(endpoint.publish("EARSHOT_A", Bytes(100'000)), Status::kOk);
  ASSERT_EQ(endpoint.publish("EARSHOT_A", Bytes{1}), Status::kOk);
  std::vector<std::uint32_t> numbers;
  for (int i = 0; i < 4; ++i) {
    const auto seen = witness.next();
    ASSERT_TRUE(seen);
    numbers.push_back(seen->number_at(4));
  }
  EXPECT_EQ(numbers, (std::vector<std::uint32_t>{0, 1, 1, 2})) << "100 kB take two datagrams";
  EXPECT_EQ(endpoint.counters().published, 3U);
}

TEST_F(OnTheWire, LeavesTheHostOnlyWhereItsUrlLetsItAndNoFurther) {
  const Witness loopback("lo");
  const Witness ethernet("eth0");
  LcmEndpoint here(parse_lcm_url(kHere), {});
  ASSERT_EQ(here.publish("EARSHOT_A", Bytes{1}), Status::kOk);
  const auto inside = loopback.next();
  ASSERT_TRUE(inside);
  EXPECT_EQ(inside->from, "127.0.0.1");
  EXPECT_EQ(inside->time_to_live, 0);
  for (const int hops : {1, 3}) {
    LcmEndpoint wide(parse_lcm_url("udpm://239.255.76.67:7667?ttl=" + std::to_string(hops)), {});
    ASSERT_EQ(wide.publish("EARSHOT_A", Bytes{1}), Status::kOk);
    const auto outside = ethernet.next();
    ASSERT_TRUE(outside);
    EXPECT_EQ(outside->from, "10.9.8.7") << "what stayed inside came before";
    EXPECT_EQ(outside->time_to_live, hops);
  }
  EXPECT_FALSE(loopback.next(0));
}

TEST_F(OnTheWire, HearsSendersOfOtherHostsOnlyWhereItsUrlLetsItAndCountsThem) {
  LcmEndpoint here(parse_lcm_url(kHere), {"EARSHOT_A"});
  LcmEndpoint wide(parse_lcm_url(kOneHop), {"EARSHOT_A"});
  const Udp elsewhere;
  elsewhere.set(IPPROTO_IP, IP_TRANSPARENT, 1);  // it may have an address that is not this host's
  elsewhere.bind_to("203.0.113.9", 0);
  elsewhere.set(IPPROTO_IP, IP_MULTICAST_IF, Udp::on("eth0"));
  elsewhere.send(kMessage);
  EXPECT_TRUE(hears_message(wide));
  EXPECT_FALSE(hears_message(here));
  EXPECT_EQ(here.counters().from_elsewhere, 1U);
  EXPECT_EQ(here.counters().received, 0U);
  EXPECT_EQ(wide.counters().from_elsewhere, 0U);
}

TEST_F(OnTheWire, HearsNoInterfaceThatAnotherProgramListensOnBeforeItDoesItself) {
  LcmEndpoint endpoint(parse_lcm_url(kOneHop), {"EARSHOT_A"});
  run("ip link add eth1 type veth peer name far1 && ip addr add 10.9.9.7/24 dev eth1 && ip link set eth1 up && ip link set far1 up");
  {
    const Witness other("eth1");
    const Udp sender;
    sender.set(IPPROTO_IP, IP_MULTICAST_IF, Udp::on("eth1"));
    sender.send(kMessage);
    ASSERT_TRUE(other.next());
    endpoint.collect();
    EXPECT_EQ(endpoint.counters().received, 0U);
    endpoint.refresh_interfaces();
    sender.send(kMessage);
    EXPECT_TRUE(hears_message(endpoint));
    EXPECT_EQ(endpoint.counters().received, 1U);
  }
  run("ip link del eth1");
}

TEST_F(OnTheWire, CountsWhatTheKernelRefusesAndNumbersItAllTheSame) {
  LcmEndpoint endpoint(parse_lcm_url(kOneHop), {});
  run("ip addr del 10.9.8.7/24 dev eth0");
  EXPECT_EQ(endpoint.publish("EARSHOT_A", Bytes{1}), Status::kFull);
  EXPECT_EQ(endpoint.counters().publish_failed, 1U);
  EXPECT_EQ(endpoint.counters().published, 0U);
  EXPECT_FALSE(endpoint.is_up());
  run("ip addr add 10.9.8.7/24 dev eth0; ip route replace default dev eth0");
  const Witness witness("eth0");
  endpoint.refresh_interfaces();
  ASSERT_EQ(endpoint.publish("EARSHOT_A", Bytes{1}), Status::kOk);
  const auto seen = witness.next();
  ASSERT_TRUE(seen);
  EXPECT_EQ(seen->number_at(4), 1U) << "a peer sees that one is missing";
  EXPECT_EQ(endpoint.counters().published, 1U);
}

TEST_F(OnTheWire, HasTheBufferThatItsUrlAsksFor) {
  const LcmEndpoint endpoint(parse_lcm_url(std::string(kHere) + "&recv_buf_size=65536"), {});
  int bytes = 0;
  socklen_t size = sizeof bytes;
  ASSERT_EQ(::getsockopt(endpoint.file_descriptor(), SOL_SOCKET, SO_RCVBUF, &bytes, &size), 0);
  EXPECT_EQ(bytes, 2 * 65'536) << "the kernel doubles what it is asked for (socket(7))";
}

TEST_F(OnTheWire, NamesTheCallThatFailedWhenTheProgramMayOpenNoMore) {
  rlimit limit{};
  ASSERT_EQ(::getrlimit(RLIMIT_NOFILE, &limit), 0);
  const rlimit none{.rlim_cur = 0, .rlim_max = limit.rlim_max};
  ASSERT_EQ(::setrlimit(RLIMIT_NOFILE, &none), 0);
  std::string said;
  try {
    const LcmEndpoint endpoint(parse_lcm_url(kHere), {});
  } catch (const std::system_error& error) {
    said = error.what();
  }
  ASSERT_EQ(::setrlimit(RLIMIT_NOFILE, &limit), 0);
  EXPECT_EQ(said.substr(0, 11), "LCM: socket");
}

// A port that hears and never sends would leave a vehicle alone.
TEST_F(OnTheWire, IsRefusedWithoutADescriptorToSendByThoughItMayWaitForItsNetwork) {
  rlimit limit{};
  ASSERT_EQ(::getrlimit(RLIMIT_NOFILE, &limit), 0);
  const int next = ::dup(STDERR_FILENO);
  ::close(next);
  const rlimit two{.rlim_cur = static_cast<rlim_t>(next) + 2, .rlim_max = limit.rlim_max};
  ASSERT_EQ(::setrlimit(RLIMIT_NOFILE, &two), 0);
  int error = 0;
  try {
    const LcmEndpoint endpoint(parse_lcm_url(kHere), {}, {}, IfMissing::kKeepTrying);
  } catch (const std::system_error& e) {
    error = e.code().value();
  }
  ASSERT_EQ(::setrlimit(RLIMIT_NOFILE, &limit), 0);
  EXPECT_EQ(error, EMFILE);
}

TEST_F(OnTheWire, NamesTheCallThatFailedWhenItsPortIsAnothers) {
  const Udp other;
  other.set(SOL_SOCKET, SO_REUSEADDR, 0);  // and will not share
  other.bind_to(kGroup, kLcmPort);
  try {
    const LcmEndpoint endpoint(parse_lcm_url(kHere), {});
    FAIL() << "it is bound where another is";
  } catch (const std::system_error& error) {
    EXPECT_EQ(error.code(), std::errc::address_in_use);
    EXPECT_NE(std::string(error.what()).find("LCM: bind"), std::string::npos) << error.what();
  }
}

TEST_F(OnTheWire, RefusesChannelsThatLcmCannotNameAndMoreThanItHasRoomFor) {
  for (const std::string& bad : {std::string(), std::string(64, 'A')}) {
    EXPECT_THROW(LcmEndpoint(parse_lcm_url(kHere), {bad}), std::invalid_argument) << bad;
  }
  const std::vector<std::string_view> many(config::kLcmSubscriptions + 1, "EARSHOT_A");
  EXPECT_THROW(LcmEndpoint(parse_lcm_url(kHere), many), std::invalid_argument);
  EXPECT_NO_THROW(LcmEndpoint(parse_lcm_url(kHere), {many.begin(), many.end() - 1}));
}

}  // namespace
}  // namespace earshot::host
