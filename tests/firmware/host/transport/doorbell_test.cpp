#include "firmware/host/transport/doorbell.hpp"

#include <gtest/gtest.h>
#include <poll.h>

namespace earshot::host {
namespace {

bool rings(const Doorbell& bell) {
  pollfd waiting{.fd = bell.file_descriptor(), .events = POLLIN, .revents = 0};
  return ::poll(&waiting, 1, 0) == 1;
}

TEST(Doorbell, RingsFromWhenItIsRungUntilItIsAnswered) {
  const Doorbell bell;
  EXPECT_FALSE(rings(bell));
  bell.ring();
  bell.ring();
  EXPECT_TRUE(rings(bell));
  bell.answer();
  EXPECT_FALSE(rings(bell)) << "rung twice it has rung once";
  bell.answer();  // waits for nobody
  bell.ring();
  EXPECT_TRUE(rings(bell));
}

}  // namespace
}  // namespace earshot::host
