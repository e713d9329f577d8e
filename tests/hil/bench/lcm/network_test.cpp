#include "hil/bench/lcm/network.hpp"

#include <gtest/gtest.h>

#include <string_view>

#include "sim/link/run_slot.hpp"

namespace earshot::hil {
namespace {

constexpr int kPatience_ms = 2000;

std::vector<std::uint8_t> bytes_of(std::string_view text) {
  return {text.begin(), text.end()};
}

/// LC02's short message: "LC02", four bytes of a sequence number, the channel and its zero, the data.
std::vector<std::uint8_t> datagram(std::string_view data) {
  return bytes_of(std::string("LC02\0\0\0\1CHANNEL\0", 16) + std::string(data));
}

class NetworkTest : public testing::Test {
 protected:
  const link::RunSlot slot_;
  Network one_{host::parse_lcm_url(slot_.lcm_url())};
  Network other_{host::parse_lcm_url(slot_.lcm_url())};
};

TEST_F(NetworkTest, HasBroughtADatagramToEverybodyElseWhenItIsSent) {
  ASSERT_TRUE(one_.send(datagram("first")));
  const std::optional<LcmMessage> heard = other_.receive(0);
  ASSERT_TRUE(heard);
  EXPECT_EQ(*heard, (LcmMessage{.channel = "CHANNEL", .data = bytes_of("first")}));
  EXPECT_FALSE(one_.receive(0)) << "what it said itself";
}

TEST_F(NetworkTest, KeepsWhatOthersSaidWhileItWaitedForItself) {
  ASSERT_TRUE(other_.send(datagram("before")));
  ASSERT_TRUE(one_.send(datagram("its own")));
  const std::optional<LcmMessage> heard = one_.receive(0);
  ASSERT_TRUE(heard);
  EXPECT_EQ(heard->data, bytes_of("before"));
}

TEST_F(NetworkTest, PassesOverWhatIsNoMessage) {
  ASSERT_TRUE(one_.send(bytes_of("LC")));
  ASSERT_TRUE(one_.send(datagram("whole")));
  const std::optional<LcmMessage> heard = other_.receive(kPatience_ms);
  ASSERT_TRUE(heard);
  EXPECT_EQ(heard->data, bytes_of("whole"));
}

}  // namespace
}  // namespace earshot::hil
