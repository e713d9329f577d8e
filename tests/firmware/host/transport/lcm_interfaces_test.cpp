#include "firmware/host/transport/lcm_interfaces.hpp"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <string>

#include "tests/support/private_network.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot::host {
namespace {

class LcmInterfacesTest : public testing::Test {
 protected:
  void SetUp() override {
    ENTER_PRIVATE_NETWORK_OR_SKIP();
    socket_ = FileDescriptor(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0));  // of that network
  }
  static void ip(const std::string& what) { ASSERT_EQ(std::system(("PATH=/usr/sbin:/usr/bin:/sbin:/bin; ip " + what).c_str()), 0) << what; }
  static void allow_memberships(int count) { std::ofstream(std::string("/proc/sys/net/ipv4/igmp_max_memberships")) << count; }

  FileDescriptor socket_;
  std::uint32_t group_ = ::inet_addr("239.255.76.67");
};

TEST_F(LcmInterfacesTest, SaysWhichInterfaceItCannotHearForTheKernelsLimitAndHearsItOnceThatIsRaised) {
  ip("link add ears0 type veth peer name ears1");
  ip("addr add 10.9.0.1/24 dev ears0");
  ip("link set ears0 up");
  allow_memberships(1);
  LcmInterfaces interfaces;
  EXPECT_EQ(interfaces.join_all(socket_.number(), group_), 1U);
  EXPECT_TRUE(support::tells(interfaces.names(), {"not ears0", "net.ipv4.igmp_max_memberships"}));
  EXPECT_EQ(interfaces.unheard(), 1U);
  allow_memberships(20);
  interfaces.refresh();
  EXPECT_EQ(interfaces.join_all(socket_.number(), group_), 2U);
  EXPECT_EQ(interfaces.names(), "lo, ears0");
  EXPECT_EQ(interfaces.unheard(), 0U);
}

TEST_F(LcmInterfacesTest, SaysHowManyAddressesItPassesOverAndNamesAnInterfaceOfManyOnce) {
  for (int i = 1; i <= 40; ++i) ip("addr add 10.9.0." + std::to_string(i) + "/32 dev lo");
  LcmInterfaces interfaces;
  (void)interfaces.join_all(socket_.number(), group_);
  EXPECT_TRUE(support::tells(interfaces.names(), {"not 9 addresses", "beyond", "32"})) << "127.0.0.1 and forty";
  EXPECT_EQ(interfaces.unheard(), 9U);
}

TEST_F(LcmInterfacesTest, HoldsAnyAddressOfLoopbackForThisHostsOwn) {
  const LcmInterfaces interfaces;
  EXPECT_TRUE(interfaces.is_own(::inet_addr("127.1.2.3")));
  EXPECT_TRUE(interfaces.is_own(INADDR_ANY));
  EXPECT_FALSE(interfaces.is_own(::inet_addr("10.0.0.127")));
}

TEST_F(LcmInterfacesTest, LeavesOutAnInterfaceThatCarriesNoMulticast) {
  ip("link add ears0 type veth peer name ears1");
  ip("addr add 10.9.0.1/24 dev ears0");
  ip("link set ears0 multicast off");
  ip("link set ears0 up");
  LcmInterfaces interfaces;
  EXPECT_EQ(interfaces.join_all(socket_.number(), group_), 1U);
  EXPECT_EQ(interfaces.names(), "lo");
}

TEST_F(LcmInterfacesTest, SaysSoWhereThereIsNone) {
  ip("link set lo down");
  LcmInterfaces interfaces;
  EXPECT_EQ(interfaces.join_all(socket_.number(), group_), 0U);
  EXPECT_EQ(interfaces.names(), "no interface");
}

}  // namespace
}  // namespace earshot::host
