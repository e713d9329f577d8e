// What becomes of a receiver whose threads cannot all be started.

#include <dlfcn.h>
#include <gtest/gtest.h>
#include <pthread.h>

#include <atomic>
#include <cerrno>
#include <system_error>

#include "firmware/boards/linux/hydrophone/hydrophone_receiver.hpp"
#include "firmware/boards/linux/hydrophone/sample_meter.hpp"

namespace {

std::atomic<int> threads_allowed{1'000'000};

}  // namespace

/// The C library's, until no more threads are allowed: then what it says where the system has no more.
extern "C" int pthread_create(pthread_t* thread, const pthread_attr_t* attributes, void* (*routine)(void*), void* argument) {
  if (threads_allowed.fetch_sub(1) <= 0) return EAGAIN;
  using Create = int (*)(pthread_t*, const pthread_attr_t*, void* (*)(void*), void*);
  static const auto create = reinterpret_cast<Create>(::dlsym(RTLD_NEXT, "pthread_create"));
  return create(thread, attributes, routine, argument);
}

namespace earshot::board {
namespace {

struct AllowAgain {
  ~AllowAgain() { threads_allowed = 1'000'000; }
};

TEST(HydrophoneReceiverThreads, ThrowsWhereTheSecondCannotBeStartedAndLeavesTheFirstNotBehind) {
  SampleMeter meter;
  const AllowAgain at_the_end;
  for (const int allowed : {0, 1}) {
    threads_allowed = allowed;
    EXPECT_THROW(HydrophoneReceiver("udpm://239.255.76.68:7668?ttl=0", meter, host::IfMissing::kKeepTrying), std::system_error) << allowed;
  }
}

}  // namespace
}  // namespace earshot::board
