#include "sim/apps/fly/other_process.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <thread>

namespace earshot::fly {
namespace {

/// A child that sleeps until it is killed.
pid_t sleeping_child() {
  const pid_t id = fork();
  if (id == 0) {
    while (true) (void)pause();
  }
  return id;
}

bool has_ended_within_a_minute(const OtherProcess& process) {
  for (const auto deadline = std::chrono::steady_clock::now() + std::chrono::minutes(1); std::chrono::steady_clock::now() < deadline;) {
    if (process.has_ended()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return false;
}

TEST(OtherProcess, HasEndedOnceItIsKilledThoughNobodyHasWaitedForIt) {
  const pid_t id = sleeping_child();
  const OtherProcess child(id);
  EXPECT_FALSE(child.has_ended());
  ASSERT_EQ(kill(id, SIGKILL), 0);
  EXPECT_TRUE(has_ended_within_a_minute(child));
  EXPECT_EQ(waitpid(id, nullptr, 0), id);
  EXPECT_TRUE(child.has_ended());
}

TEST(OtherProcess, HasEndedWhereItWasGoneBefore) {
  const pid_t id = sleeping_child();
  ASSERT_EQ(kill(id, SIGKILL), 0);
  ASSERT_EQ(waitpid(id, nullptr, 0), id);
  EXPECT_TRUE(OtherProcess(id).has_ended());
}

}  // namespace
}  // namespace earshot::fly
