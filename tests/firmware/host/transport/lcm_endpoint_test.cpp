#include "firmware/host/transport/lcm_endpoint.hpp"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <malloc.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <lcm/lcm-cpp.hpp>
#include <memory>
#include <string>
#include <vector>

#include "earshot/nav_state_t.hpp"
#include "firmware/wire/lcm/channels.hpp"
#include "tests/support/lcm_peer.hpp"
#include "tests/support/private_network.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot::host {
namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr const char* kUrl = "udpm://239.255.76.67:7667?ttl=0";
constexpr int kPatience_ms = 5000;  ///< for a message that must come; only a failing test waits so long

Bytes counting(std::size_t size) {
  Bytes bytes(size);
  for (std::size_t i = 0; i < size; ++i) bytes[i] = static_cast<std::uint8_t>(i * 7 + i / 251);
  return bytes;
}

class LcmEndpointTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    isolated_ = test::enter_private_network();
    ASSERT_TRUE(isolated_ || test::may_do_without_private_network()) << test::kNoPrivateNetwork;
  }
  void SetUp() override {
    if (!isolated_) GTEST_SKIP() << test::kOnlyRootMayHavePrivateNetwork;
  }

  /// The next message, waiting for it.
  static bool receive(LcmEndpoint& endpoint, wire::Lc02Message& message) {
    for (;;) {
      if (endpoint.take(message) == Status::kOk) return true;
      pollfd ready{endpoint.file_descriptor(), POLLIN, 0};
      if (::poll(&ready, 1, kPatience_ms) != 1) return false;
      endpoint.collect();
    }
  }

  static inline bool isolated_ = false;
};

nav_state_t some_nav_state() {
  nav_state_t nav{};
  nav.utime = 1'700'000'000'123'456;
  nav.north_m = 12'345.678;
  nav.east_m = -0.25;
  nav.depth_m = 300.0;
  nav.heading_rad = 1.5;
  nav.speed_mps = 2.0;
  return nav;
}

/// Remembers what liblcm hands over.
struct Inbox {
  std::vector<std::pair<std::string, Bytes>> messages;
  void on_message(const lcm::ReceiveBuffer* buffer, const std::string& channel) {
    const auto* begin = static_cast<const std::uint8_t*>(buffer->data);
    messages.emplace_back(channel, Bytes(begin, begin + buffer->data_size));
  }
};

class LiblcmPeer : public LcmEndpointTest {
 protected:
  void SetUp() override {
    LcmEndpointTest::SetUp();
    if (IsSkipped() || HasFatalFailure()) return;
    peer_ = std::make_unique<lcm::LCM>(kUrl);
    ASSERT_TRUE(peer_->good());
    peer_->subscribe("EARSHOT.*", &Inbox::on_message, &inbox_);
  }

  std::unique_ptr<lcm::LCM> peer_;
  Inbox inbox_;
};

TEST_F(LiblcmPeer, IsHeardFieldByField) {
  LcmEndpoint endpoint(parse_lcm_url(kUrl), {wire::kNavStateChannel});
  const nav_state_t sent = some_nav_state();
  ASSERT_EQ(peer_->publish("EARSHOT_NAV_STATE", &sent), 0);
  wire::Lc02Message message;
  ASSERT_TRUE(receive(endpoint, message));
  EXPECT_EQ(message.channel, wire::kNavStateChannel);
  nav_state_t nav{};
  ASSERT_EQ(support::read_peer(message.data, nav), Status::kOk);
  EXPECT_EQ(nav.utime, sent.utime);
  EXPECT_EQ(nav.north_m, sent.north_m);
  EXPECT_EQ(nav.speed_mps, sent.speed_mps);
}

TEST_F(LiblcmPeer, HearsUsFieldByField) {
  LcmEndpoint endpoint(parse_lcm_url(kUrl), {});
  ASSERT_EQ(endpoint.publish(wire::kNavStateChannel, support::bytes_of(some_nav_state())), Status::kOk);
  ASSERT_EQ(peer_->handleTimeout(kPatience_ms), 1);
  ASSERT_EQ(inbox_.messages.size(), 1U);
  EXPECT_EQ(inbox_.messages[0].first, "EARSHOT_NAV_STATE");
  nav_state_t nav{};
  ASSERT_EQ(support::read_peer(inbox_.messages[0].second, nav), Status::kOk);
  EXPECT_EQ(nav.utime, some_nav_state().utime);
  EXPECT_EQ(nav.north_m, some_nav_state().north_m);
  EXPECT_EQ(nav.speed_mps, some_nav_state().speed_mps);
}

TEST_F(LiblcmPeer, IsHeardWhenItSendsInFragments) {
  LcmEndpoint endpoint(parse_lcm_url(kUrl), {"EARSHOT_LARGE"});
  for (const std::size_t size : {65'498UL, 100'000UL, config::kLcmMessageBytes}) {
    const Bytes sent = counting(size);
    ASSERT_EQ(peer_->publish("EARSHOT_LARGE", sent.data(), static_cast<unsigned>(sent.size())), 0);
    wire::Lc02Message message;
    ASSERT_TRUE(receive(endpoint, message)) << size;
    EXPECT_EQ(Bytes(message.data.begin(), message.data.end()), sent) << size;
  }
}

TEST_F(LiblcmPeer, HearsUsWhenWeSendInFragments) {
  LcmEndpoint endpoint(parse_lcm_url(kUrl), {});
  for (const std::size_t size : {65'487UL, 65'498UL, 100'000UL, config::kLcmMessageBytes}) {
    inbox_.messages.clear();
    ASSERT_EQ(endpoint.publish("EARSHOT_LARGE", counting(size)), Status::kOk);
    ASSERT_EQ(peer_->handleTimeout(kPatience_ms), 1) << size;
    EXPECT_EQ(inbox_.messages.at(0).second, counting(size)) << size;
  }
}

TEST_F(LcmEndpointTest, TellsTheMemoryOfItsQueues) {
  const LcmEndpoint one(parse_lcm_url(kUrl), std::vector<std::string_view>{"EARSHOT_A"});
  const LcmEndpoint two(parse_lcm_url(kUrl), std::vector<std::string_view>{"EARSHOT_A", "EARSHOT_B"});
  EXPECT_GE(two.memory() - one.memory(), config::kLcmQueueDepth * config::kLcmMessageBytes) << "of a queue";
  EXPECT_GT(one.memory(), two.memory() - one.memory()) << "there is more than its queue";
}

TEST_F(LcmEndpointTest, HearsAnotherEndpointButNotItself) {
  LcmEndpoint alice(parse_lcm_url(kUrl), {"EARSHOT_A", "EARSHOT_B"});
  LcmEndpoint bob(parse_lcm_url(kUrl), {"EARSHOT_A", "EARSHOT_B"});
  ASSERT_EQ(alice.publish("EARSHOT_A", Bytes{1}), Status::kOk);
  ASSERT_EQ(bob.publish("EARSHOT_B", Bytes{2}), Status::kOk);
  wire::Lc02Message message;
  ASSERT_TRUE(receive(alice, message));
  EXPECT_EQ(message.channel, "EARSHOT_B");
  ASSERT_TRUE(receive(bob, message));
  EXPECT_EQ(message.channel, "EARSHOT_A");
  EXPECT_EQ(alice.take(message), Status::kNotReady);
}

TEST_F(LcmEndpointTest, HandsOutMessagesInTheOrderOfTheirArrivalOverAllChannels) {
  LcmEndpoint sender(parse_lcm_url(kUrl), {});
  LcmEndpoint receiver(parse_lcm_url(kUrl), {"EARSHOT_A", "EARSHOT_B"});
  for (const std::uint8_t i : {std::uint8_t{0}, std::uint8_t{1}, std::uint8_t{2}, std::uint8_t{3}}) {
    ASSERT_EQ(sender.publish(i % 2 == 0 ? "EARSHOT_B" : "EARSHOT_A", Bytes{i}), Status::kOk);
  }
  for (const std::uint8_t i : {std::uint8_t{0}, std::uint8_t{1}, std::uint8_t{2}, std::uint8_t{3}}) {
    wire::Lc02Message message;
    ASSERT_TRUE(receive(receiver, message));
    EXPECT_EQ(message.data[0], i);
  }
}

TEST_F(LcmEndpointTest, KeepsTheNewestOfAFloodAndLosesNothingOfTheOtherChannels) {
  LcmEndpoint sender(parse_lcm_url(kUrl), {});
  LcmEndpoint receiver(parse_lcm_url(kUrl), {"EARSHOT_FLOOD", "EARSHOT_RARE"});
  ASSERT_EQ(sender.publish("EARSHOT_RARE", Bytes{42}), Status::kOk);
  for (std::uint8_t i = 0; i < 200; ++i) ASSERT_EQ(sender.publish("EARSHOT_FLOOD", Bytes{i}), Status::kOk);
  receiver.collect();
  wire::Lc02Message message;
  ASSERT_EQ(receiver.take(message), Status::kOk);
  EXPECT_EQ(message.channel, "EARSHOT_RARE");
  for (std::size_t i = 0; i < config::kLcmQueueDepth; ++i) {
    ASSERT_EQ(receiver.take(message), Status::kOk);
    EXPECT_EQ(message.data[0], 200 - config::kLcmQueueDepth + i);
  }
  EXPECT_EQ(receiver.take(message), Status::kNotReady);
  EXPECT_EQ(receiver.counters().overwritten, 200U - config::kLcmQueueDepth);
}

TEST_F(LcmEndpointTest, KeepsWhatMustBeKeptHoweverManyNewerOnesFollowIt) {
  const auto begins_with_nine = [](std::string_view, std::span<const std::uint8_t> data) { return data[0] == 9; };
  LcmEndpoint sender(parse_lcm_url(kUrl), {});
  LcmEndpoint receiver(parse_lcm_url(kUrl), {"EARSHOT_A"}, begins_with_nine);
  for (const std::uint8_t byte : Bytes{1, 9, 2, 3, 4, 5, 6, 7}) ASSERT_EQ(sender.publish("EARSHOT_A", Bytes{byte}), Status::kOk);
  receiver.collect();
  wire::Lc02Message message;
  for (const std::uint8_t expected : Bytes{9, 5, 6, 7}) {
    ASSERT_EQ(receiver.take(message), Status::kOk);
    EXPECT_EQ(message.data[0], expected);
  }
  EXPECT_EQ(receiver.take(message), Status::kNotReady);
  EXPECT_EQ(receiver.counters().overwritten, 4U);
}

TEST_F(LcmEndpointTest, LosesTheNewestOfAQueueThatHoldsNothingButWhatMustBeKept) {
  LcmEndpoint sender(parse_lcm_url(kUrl), {});
  LcmEndpoint receiver(parse_lcm_url(kUrl), {"EARSHOT_A"}, [](std::string_view, std::span<const std::uint8_t>) { return true; });
  for (const std::uint8_t byte : Bytes{1, 2, 3, 4, 5}) ASSERT_EQ(sender.publish("EARSHOT_A", Bytes{byte}), Status::kOk);
  receiver.collect();
  wire::Lc02Message message;
  for (const std::uint8_t expected : Bytes{1, 2, 3, 4}) {
    ASSERT_EQ(receiver.take(message), Status::kOk);
    EXPECT_EQ(message.data[0], expected);
  }
  EXPECT_EQ(receiver.counters().overwritten, 1U);
}

TEST_F(LcmEndpointTest, CountsEveryDatagramThatTheKernelDroppedThoughNoneCameAfterThem) {
  LcmEndpoint sender(parse_lcm_url(kUrl), {});
  LcmEndpoint receiver(parse_lcm_url(std::string(kUrl) + "&recv_buf_size=4096"), {});
  constexpr std::uint64_t kSent = 1000;
  for (std::uint64_t i = 0; i < kSent; ++i) ASSERT_EQ(sender.publish("EARSHOT_X", {}), Status::kOk);
  receiver.collect();
  const LcmCounters counters = receiver.counters();
  EXPECT_GT(counters.lost_by_kernel, 0U);
  EXPECT_EQ(counters.lost_by_kernel + counters.other_channels, kSent);
}

/// A host as hosts are: an Ethernet interface with an address, and every route, multicast's too, leads there.
class OnAHostWithEthernet : public LcmEndpointTest {
 protected:
  void SetUp() override {
    LcmEndpointTest::SetUp();
    if (IsSkipped() || HasFatalFailure()) return;
    ASSERT_EQ(
        std::system("PATH=/usr/sbin:/usr/bin:/sbin:/bin; ip link add eth0 type veth peer name far0 && ip addr add 10.9.8.7/24 dev eth0 &&"
                    " ip link set eth0 up && ip link set far0 up && ip route del 224.0.0.0/4 dev lo && ip route add default dev eth0"),
        0);
  }
  void TearDown() override {
    if (!isolated_) return;
    ASSERT_EQ(std::system("PATH=/usr/sbin:/usr/bin:/sbin:/bin; ip link del eth0; ip route add 224.0.0.0/4 dev lo"), 0);
  }
};

TEST_F(OnAHostWithEthernet, HearsAStockPeerWhoseMulticastTakesTheDefaultRoute) {
  lcm::LCM peer(kUrl);
  ASSERT_TRUE(peer.good());
  LcmEndpoint endpoint(parse_lcm_url(kUrl), {wire::kNavStateChannel});
  EXPECT_EQ(endpoint.interfaces(), "lo, eth0");
  const nav_state_t sent = some_nav_state();
  ASSERT_EQ(peer.publish("EARSHOT_NAV_STATE", &sent), 0);
  wire::Lc02Message message;
  EXPECT_TRUE(receive(endpoint, message));
  EXPECT_EQ(endpoint.take(message), Status::kNotReady) << "once, not once an interface";
}

TEST_F(OnAHostWithEthernet, IsHeardByAStockPeer) {
  lcm::LCM peer(kUrl);
  Inbox inbox;
  peer.subscribe("EARSHOT.*", &Inbox::on_message, &inbox);
  LcmEndpoint endpoint(parse_lcm_url(kUrl), {});
  ASSERT_EQ(endpoint.publish(wire::kNavStateChannel, support::bytes_of(some_nav_state())), Status::kOk);
  EXPECT_EQ(peer.handleTimeout(kPatience_ms), 1);
}

TEST_F(OnAHostWithEthernet, SendsAgainWhenTheHostsAddressHasChanged) {
  constexpr const char* kWide = "udpm://239.255.76.67:7667?ttl=1";
  LcmEndpoint endpoint(parse_lcm_url(kWide), {});
  ASSERT_EQ(endpoint.publish("EARSHOT_A", Bytes{1}), Status::kOk);
  ASSERT_EQ(std::system("PATH=/usr/sbin:/usr/bin:/sbin:/bin; ip addr del 10.9.8.7/24 dev eth0"), 0);
  (void)endpoint.publish("EARSHOT_A", Bytes{2});
  EXPECT_FALSE(endpoint.is_up());
  ASSERT_EQ(std::system("PATH=/usr/sbin:/usr/bin:/sbin:/bin; ip addr add 10.9.8.9/24 dev eth0; ip route replace default dev eth0"), 0);
  endpoint.refresh_interfaces();
  EXPECT_TRUE(endpoint.is_up());
  EXPECT_EQ(endpoint.publish("EARSHOT_A", Bytes{3}), Status::kOk);
}

TEST_F(LcmEndpointTest, HearsAnInterfaceThatComesUpAfterIt) {
  LcmEndpoint endpoint(parse_lcm_url(kUrl), {wire::kNavStateChannel});
  EXPECT_EQ(endpoint.interfaces(), "lo");
  ASSERT_EQ(
      std::system("PATH=/usr/sbin:/usr/bin:/sbin:/bin; ip link add eth1 type veth peer name far1 && ip addr add 10.9.9.7/24 dev eth1 &&"
                  " ip link set eth1 up"),
      0);
  endpoint.refresh_interfaces();
  EXPECT_EQ(endpoint.interfaces(), "lo, eth1");
  ASSERT_EQ(std::system("PATH=/usr/sbin:/usr/bin:/sbin:/bin; ip link del eth1"), 0);
}

TEST_F(LcmEndpointTest, IsDownWhileThereIsNoNetworkAndHeardAndHeardFromOnceThereIs) {
  ASSERT_EQ(std::system("PATH=/usr/sbin:/usr/bin:/sbin:/bin; ip link set lo down"), 0);
  std::string said;
  try {
    const LcmEndpoint refused(parse_lcm_url(kUrl), {});
  } catch (const std::system_error& error) {
    said = error.what();
  }
  EXPECT_TRUE(support::has_line(said, {"LCM", "no interface", "up", "multicast"})) << said;
  LcmEndpoint early(parse_lcm_url(kUrl), {"EARSHOT_X"}, nullptr, IfMissing::kKeepTrying);
  EXPECT_FALSE(early.is_up());
  EXPECT_EQ(early.publish("EARSHOT_X", {}), Status::kFull);
  early.refresh_interfaces();
  EXPECT_FALSE(early.is_up());
  ASSERT_EQ(std::system("PATH=/usr/sbin:/usr/bin:/sbin:/bin; ip link set lo up; ip route add 224.0.0.0/4 dev lo"), 0);
  early.refresh_interfaces();
  EXPECT_TRUE(early.is_up());
  EXPECT_EQ(early.interfaces(), "lo");
  LcmEndpoint late(parse_lcm_url(kUrl), {"EARSHOT_X"});
  wire::Lc02Message message;
  ASSERT_EQ(late.publish("EARSHOT_X", Bytes{1}), Status::kOk);
  EXPECT_TRUE(receive(early, message));
  ASSERT_EQ(early.publish("EARSHOT_X", Bytes{2}), Status::kOk);
  EXPECT_TRUE(receive(late, message));
}

TEST_F(LcmEndpointTest, ReadsABoundedNumberOfDatagramsInOneTurn) {
  LcmEndpoint sender(parse_lcm_url(kUrl), {});
  LcmEndpoint receiver(parse_lcm_url(std::string(kUrl) + "&recv_buf_size=1000000"), {});
  for (std::size_t i = 0; i < config::kLcmDatagramsPerCollect + 10; ++i) ASSERT_EQ(sender.publish("EARSHOT_X", {}), Status::kOk);
  receiver.collect();
  EXPECT_EQ(receiver.counters().other_channels, config::kLcmDatagramsPerCollect);
}

TEST_F(LcmEndpointTest, SpendsNoMemoryOnTwoHundredThousandStrangeChannels) {
  LcmEndpoint sender(parse_lcm_url(kUrl), {});
  LcmEndpoint receiver(parse_lcm_url(kUrl), {"EARSHOT_A"});
  std::string channel = "STRANGE_000000";
  const auto send_and_collect = [&](int number) {
    for (std::size_t digit = channel.size(); digit-- > 8; number /= 10) channel[digit] = static_cast<char>('0' + number % 10);
    ASSERT_EQ(sender.publish(channel, {}), Status::kOk);
    receiver.collect();
  };
  send_and_collect(0);
  const std::size_t before = ::mallinfo2().uordblks + ::mallinfo2().hblkhd;
  for (int i = 1; i < 200'000; ++i) send_and_collect(i);
  EXPECT_EQ(::mallinfo2().uordblks + ::mallinfo2().hblkhd, before);
  EXPECT_EQ(receiver.counters().other_channels, 200'000U);
}

TEST_F(LcmEndpointTest, CountsDatagramsThatAreNotLcmAndGoesOn) {
  LcmEndpoint sender(parse_lcm_url(kUrl), {});
  LcmEndpoint receiver(parse_lcm_url(kUrl), {"EARSHOT_A"});
  const int raw = ::socket(AF_INET, SOCK_DGRAM, 0);
  sockaddr_in to{};
  to.sin_family = AF_INET;
  to.sin_port = htons(7667);
  to.sin_addr.s_addr = ::inet_addr("239.255.76.67");
  for (const std::string& datagram : {std::string(), std::string("LC02"), std::string("LC02\0\0\0\1AAAA", 12),
                                      std::string("LC03\0\0\0\1", 8), std::string(60'000, 'L')}) {
    ASSERT_GE(::sendto(raw, datagram.data(), datagram.size(), 0, reinterpret_cast<sockaddr*>(&to), sizeof to), 0);
  }
  ::close(raw);
  ASSERT_EQ(sender.publish("EARSHOT_A", Bytes{1}), Status::kOk);
  wire::Lc02Message message;
  ASSERT_TRUE(receive(receiver, message));
  EXPECT_EQ(message.channel, "EARSHOT_A");
  EXPECT_EQ(receiver.counters().datagrams.malformed, 5U);
}

TEST_F(LcmEndpointTest, RefusesToPublishWhatLcmCannotCarry) {
  LcmEndpoint endpoint(parse_lcm_url(kUrl), {});
  EXPECT_EQ(endpoint.publish("", {}), Status::kOutOfRange);
  EXPECT_EQ(endpoint.publish(std::string(64, 'A'), {}), Status::kOutOfRange);
  EXPECT_EQ(endpoint.publish("A", Bytes(config::kLcmMessageBytes + 1)), Status::kOutOfRange);
}

}  // namespace
}  // namespace earshot::host
