#include <cstdlib>

#include "firmware/wire/n2k/table/messages.hpp"
#include "tests/firmware/boards/linux/can/bus_rig.hpp"

namespace earshot::board {
namespace {

int ip_link(const std::string& what) {
  return std::system(("PATH=/usr/sbin:/usr/bin:/sbin:/bin; ip link " + what).c_str());
}

class CanPortLinkTest : public BusRig {
 protected:
  std::uint64_t publish_setpoint() {
    runtime::Outputs outputs;
    outputs.setpoint.emplace();
    return port_->publish(clock_.time, outputs);
  }
};

TEST_F(CanPortLinkTest, ClaimsAnAddressOnALinkThatComesAfterIt) {
  if (ip_link("add vcan78 type vcan") != 0) GTEST_SKIP() << "only root may make an interface";
  ASSERT_EQ(ip_link("del vcan78"), 0);
  settings_.address = "vcan78";
  open();
  EXPECT_TRUE(port_->settle()) << "nobody waits for a link that is not there";
  serve_for(Duration::seconds(1));
  EXPECT_EQ(publish_setpoint(), 0U);
  ASSERT_EQ(ip_link("add vcan78 type vcan"), 0);
  ASSERT_EQ(ip_link("set vcan78 up"), 0);
  join("vcan78");
  port_->tend();
  port_->serve();
  EXPECT_EQ(heard(n2k::kAddressClaimPgn).size(), 1U);
  serve_for(Duration::milliseconds(300));
  EXPECT_EQ(publish_setpoint(), 1U);
  ASSERT_EQ(ip_link("del vcan78"), 0);
}

TEST_F(CanPortLinkTest, ClaimsItsAddressAnewOnALinkThatCameBack) {
  if (ip_link("add vcan78 type vcan") != 0) GTEST_SKIP() << "only root may make an interface";
  ASSERT_EQ(ip_link("set vcan78 up"), 0);
  settings_.address = "vcan78";
  join("vcan78");
  open_settled();
  ASSERT_EQ(ip_link("set vcan78 down"), 0);
  collect();
  EXPECT_FALSE(port_->report().link_up);
  EXPECT_EQ(publish_setpoint(), 0U);
  port_->serve();
  ASSERT_EQ(ip_link("set vcan78 up"), 0);
  join("vcan78");
  port_->tend();
  port_->serve();
  EXPECT_EQ(publish_setpoint(), 0U);
  const std::vector<Heard> said = heard();
  ASSERT_EQ(said.size(), 1U);
  EXPECT_EQ(said[0].identifier.pgn, n2k::kAddressClaimPgn);
  serve_for(Duration::milliseconds(300));
  EXPECT_EQ(publish_setpoint(), 1U);
  ASSERT_EQ(ip_link("del vcan78"), 0);
}

}  // namespace
}  // namespace earshot::board
