#include "firmware/host/transport/wake_event.hpp"

#include <gtest/gtest.h>
#include <poll.h>

namespace earshot::host {
namespace {

bool is_set(const WakeEvent& event) {
  pollfd waiting{.fd = event.file_descriptor(), .events = POLLIN, .revents = 0};
  return ::poll(&waiting, 1, 0) == 1;
}

TEST(WakeEvent, RingsFromWhenItIsRungUntilItIsAnswered) {
  const WakeEvent event;
  EXPECT_FALSE(is_set(event));
  event.signal();
  event.signal();
  EXPECT_TRUE(is_set(event));
  event.clear();
  EXPECT_FALSE(is_set(event)) << "rung twice it has rung once";
  event.clear();  // waits for nobody
  event.signal();
  EXPECT_TRUE(is_set(event));
}

}  // namespace
}  // namespace earshot::host
