// Who can reach the simulation link: this host, and no other.

#include "sim/link/session.hpp"

#include <gtest/gtest.h>

#include <fcntl.h>
#include <netinet/in.h>
#include <sched.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "tests/support/private_network.hpp"

namespace earshot::link {
namespace {

// DDSI-RTPS 2.2, 9.6.1.1: discovery by unicast of the first participant in domain d is on port 7400 + 250 d + 10.
constexpr std::uint32_t kDomain = 50;
constexpr std::uint16_t kDiscoveryPort = 7400 + 250 * kDomain + 10;
constexpr std::uint32_t kNear = 0x0A090801;  // 10.9.8.1

/// Whether a socket receives what is sent to `address`: where none does, the kernel answers, and the sender's socket is told.
bool is_received_at(std::uint32_t address) {
  const int sender = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  sockaddr_in to{};
  to.sin_family = AF_INET;
  to.sin_port = htons(kDiscoveryPort);
  to.sin_addr.s_addr = htonl(address);
  EXPECT_EQ(connect(sender, reinterpret_cast<const sockaddr*>(&to), sizeof(to)), 0);
  EXPECT_EQ(send(sender, "RTPS", 4, 0), 4);
  const timeval patience{.tv_sec = 1, .tv_usec = 0};
  (void)setsockopt(sender, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof(patience));
  char nothing = 0;
  const bool is_refused = recv(sender, &nothing, 1, 0) < 0 && errno == ECONNREFUSED;
  close(sender);
  return !is_refused;
}

bool does(const std::string& command) {
  return std::system(("PATH=/usr/sbin:/usr/bin:/sbin:/bin; " + command).c_str()) == 0;
}

TEST(Session, IsReachedFromThisHostAndFromNoOther) {
  if (!test::enter_private_network()) GTEST_SKIP() << "no network namespace can be made";
  // Another network, with a cable to this one: two hosts.
  const std::string make_neighbour =
      "ip link add near type veth peer name far && ip address add 10.9.8.1/24 dev near && ip link set near up";
  if (!does(make_neighbour)) GTEST_SKIP() << "no cable to another network can be made";
  int go[2];
  ASSERT_EQ(pipe(go), 0);
  const pid_t neighbour = fork();
  if (neighbour == 0) {
    char word = 0;
    if (unshare(CLONE_NEWNET) != 0 || write(go[1], "n", 1) != 1) std::_Exit(3);
    while (!does("ip link show far >/dev/null 2>&1")) usleep(10'000);
    if (!does("ip address add 10.9.8.2/24 dev far && ip link set far up")) std::_Exit(4);
    while (read(go[0], &word, 1) == 1 && word != 's') {  // the session is there
      if (word == 'n') std::_Exit(5);
    }
    std::_Exit(is_received_at(kNear) ? 1 : 0);
  }
  char word = 0;
  ASSERT_EQ(read(go[0], &word, 1), 1);
  ASSERT_TRUE(does("ip link set far netns " + std::to_string(neighbour)));
  {
    const Session session(kDomain);
    EXPECT_TRUE(is_received_at(INADDR_LOOPBACK));
    ASSERT_EQ(write(go[1], "s", 1), 1);
    int status = -1;
    waitpid(neighbour, &status, 0);
    EXPECT_EQ(WEXITSTATUS(status), 0) << "1: received from another host; more: the test itself could not do its work";
  }
}

TEST(Session, ItsSocketsEndWithItThoughAProgramThatWasStartedMeanwhileLivesOn) {
  if (!test::enter_private_network()) GTEST_SKIP() << "no network namespace can be made";
  FILE* started = nullptr;
  {
    const Session session(kDomain);
    started = popen("exec cat", "w");
    ASSERT_NE(started, nullptr);
    EXPECT_TRUE(is_received_at(INADDR_LOOPBACK));
  }
  EXPECT_FALSE(is_received_at(INADDR_LOOPBACK));
  pclose(started);
}

}  // namespace
}  // namespace earshot::link
