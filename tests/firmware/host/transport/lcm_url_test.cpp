#include "firmware/host/transport/lcm_url.hpp"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

#include "tests/support/text/tells.hpp"

namespace earshot::host {
namespace {

/// What parse_lcm_url says against `url`; empty if nothing.
std::string complaint(const std::string& url) {
  try {
    static_cast<void>(parse_lcm_url(url));
    return {};
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
}

TEST(LcmUrl, ReadsTheDefaultAsLcmDocumentsIt) {
  const LcmUrl url = parse_lcm_url(kDefaultLcmUrl);
  EXPECT_EQ(url.group, 0xEFFF4C43U);  // 239.255.76.67
  EXPECT_EQ(url.port, 7667);
  EXPECT_EQ(url.ttl, 0);
}

TEST(LcmUrl, StaysOnThisHostUnlessTold) {
  EXPECT_EQ(parse_lcm_url("udpm://239.255.76.67:7667").ttl, 0);
  EXPECT_EQ(parse_lcm_url("udpm://239.255.76.67:7667?ttl=1&recv_buf_size=65536").ttl, 1);
  EXPECT_EQ(parse_lcm_url("udpm://239.255.76.67:7667?ttl=1&recv_buf_size=65536").receive_buffer_bytes, 65'536);
}

TEST(LcmUrl, SaysWhichPartIsWrongAndWhatIsAllowed) {
  EXPECT_TRUE(support::tells(complaint("tcpq://localhost"), {"LCM", "URL", "tcpq://localhost", "udpm://GROUP:PORT?ttl=N"}));
  EXPECT_TRUE(support::tells(complaint("udpm://10.0.0.1:7667"), {"LCM", "10.0.0.1", "IPv4", "224.0.0.0 to 239.255.255.255"}));
  EXPECT_TRUE(support::tells(complaint("udpm://239.255.76.67:0"), {"LCM", "0", "1 to 65535"}));
  EXPECT_TRUE(support::tells(complaint("udpm://239.255.76.67"), {"LCM", "1 to 65535"}));
  EXPECT_TRUE(support::tells(complaint("udpm://239.255.76.67:7667?ttl=256"), {"LCM", "256", "0 to 255"}));
  EXPECT_TRUE(support::tells(complaint("udpm://239.255.76.67:7667?ttl=1x"), {"LCM", "1x", "0 to 255"}));
  EXPECT_TRUE(support::tells(complaint("udpm://239.255.76.67:7667?hops=1"), {"LCM", "hops=1", "ttl=N", "recv_buf_size=N"}));
}

}  // namespace
}  // namespace earshot::host
