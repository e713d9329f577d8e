#include "firmware/host/memory/process_memory.hpp"

#include <gtest/gtest.h>
#include <pthread.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <span>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

#include "firmware/host/memory/heap_trap.hpp"

namespace earshot::host {
namespace {

constexpr std::size_t kMebibyte = std::size_t{1} << 20U;

/// Pages of a mapping that are in physical memory, as the kernel says.
std::size_t resident_pages(void* mapped, std::size_t bytes) {
  std::vector<unsigned char> pages(bytes / static_cast<std::size_t>(::sysconf(_SC_PAGESIZE)));
  EXPECT_EQ(::mincore(mapped, bytes, pages.data()), 0);
  return static_cast<std::size_t>(std::ranges::count_if(pages, [](unsigned char page) { return (page & 1U) != 0; }));
}

class TouchedMemory : public testing::Test {
 protected:
  void SetUp() override {
    if (!kHeapTrapCounts) GTEST_SKIP() << "a sanitizer's shadow memory is not touched";
  }
};

TEST_F(TouchedMemory, IsThereToTheLastPageAndHoldsWhatItHeld) {
  void* const mapped = ::mmap(nullptr, kMebibyte, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  ASSERT_NE(mapped, MAP_FAILED);
  const std::span bytes(static_cast<unsigned char*>(mapped), kMebibyte);
  bytes[0] = 17;
  ASSERT_EQ(resident_pages(mapped, kMebibyte), 1);
  touch_memory();
  EXPECT_EQ(resident_pages(mapped, kMebibyte), kMebibyte / static_cast<std::size_t>(::sysconf(_SC_PAGESIZE)));
  EXPECT_EQ(bytes[0], 17);
  EXPECT_EQ(bytes[1], 0);
  ::munmap(mapped, kMebibyte);
}

TEST_F(TouchedMemory, LosesNoWriteOfAnotherThread) {
  struct alignas(4096) Page {
    std::atomic<std::uint64_t> count;  // where the page is touched
  };
  std::array<Page, 16> pages{};
  std::atomic<bool> stop{false};
  std::uint64_t rounds = 0;
  std::thread writer([&] {
    for (; !stop; ++rounds) {
      for (Page& page : pages) page.count.fetch_add(1, std::memory_order_relaxed);
    }
  });
  for (int i = 0; i < 400; ++i) touch_memory();
  stop = true;
  writer.join();
  for (const Page& page : pages) EXPECT_EQ(page.count, rounds);
}

/// In a frame of its own: inlined, it would be part of the test's, which lies above what was painted.
[[gnu::noinline]] void use_stack(std::size_t bytes) {
  auto* const room = static_cast<volatile unsigned char*>(__builtin_alloca(bytes));
  for (std::size_t i = 0; i < bytes; ++i) room[i] = 1;
}

TEST_F(TouchedMemory, OfTheMainStackIsCountedAsUsedFromWhereItWasUsed) {
  touch_stack(256 * 1024);
  const std::size_t before = touched_stack_used();
  use_stack(100'000);
  EXPECT_LT(before, 20'000);
  // Counted from where touch_stack() began to paint, which may lie a little below where use_stack() begins.
  EXPECT_GE(touched_stack_used(), 99'000);
  EXPECT_LT(touched_stack_used(), 110'000);
}

TEST(TouchedStack, LeavesHalfOfASmallOneFree) {
  const auto touch_with_small_limit = [] {
    rlimit limit{};
    ::getrlimit(RLIMIT_STACK, &limit);
    limit.rlim_cur = 1024 * 1024;  // the process is ended as it reaches there
    ::setrlimit(RLIMIT_STACK, &limit);
    touch_stack(4 * 1024 * 1024);  // more than anybody has used of it so far
    ::_exit(0);
  };
  EXPECT_EXIT(touch_with_small_limit(), testing::ExitedWithCode(0), "");
}

TEST(ThreadStack, HasTheSizeThatWasSetForEveryThreadMadeSince) {
  pthread_attr_t before;
  ASSERT_EQ(::pthread_getattr_default_np(&before), 0);
  set_thread_stack(192 * 1024);
  std::size_t size = 0;
  std::thread([&size] {
    pthread_attr_t own;
    if (::pthread_getattr_np(::pthread_self(), &own) == 0) (void)::pthread_attr_getstacksize(&own, &size);
    (void)::pthread_attr_destroy(&own);
  }).join();
  EXPECT_EQ(::pthread_setattr_default_np(&before), 0);
  EXPECT_EQ(size, 192 * 1024);
}

TEST(ThreadStack, OfOneByteIsRefused) {
  EXPECT_THROW(set_thread_stack(1), std::system_error);
}

TEST(LockedMemory, IsAllThereIsOrItIsSaidWhatTheSystemAllowsAndWhatIsNeeded) {
  if (!kHeapTrapCounts) GTEST_SKIP() << "a sanitizer locks nothing";
  const std::string remark = lock_memory();
  if (remark.empty()) {
    EXPECT_GT(process_memory().locked, kMebibyte);
    EXPECT_EQ(::munlockall(), 0);
  } else {
    EXPECT_NE(remark.find("ulimit -l"), std::string::npos) << remark;
  }
}

TEST(LockedMemory, ThatIsNotAllowedIsAskedForInWords) {
  if (!kHeapTrapCounts) GTEST_SKIP() << "a sanitizer locks nothing";
  const auto without_the_right = [] {
    const rlimit little{.rlim_cur = 65'536, .rlim_max = 65'536};
    if (::setrlimit(RLIMIT_MEMLOCK, &little) != 0 || (::geteuid() == 0 && ::seteuid(65'534) != 0)) ::_exit(3);
    const std::string remark = lock_memory();
    ::_exit(remark.find("the system allows 64 kB, needed are ") != std::string::npos &&
                    remark.find("LimitMEMLOCK=infinity") != std::string::npos
                ? 0
                : 4);
  };
  EXPECT_EXIT(without_the_right(), testing::ExitedWithCode(0), "");
}

TEST(ProcessMemory, IsWhatTheKernelListsInKilobytes) {
  std::ifstream status("/proc/self/status");
  std::uint64_t listed_kb = 0;
  for (std::string line; std::getline(status, line);) {
    if (line.starts_with("VmSize:")) listed_kb = std::stoull(line.substr(7));
  }
  ASSERT_GT(listed_kb, 1000);
  const std::uint64_t told = process_memory().address_space;
  EXPECT_GE(told, listed_kb * 1024);
  EXPECT_LE(told, listed_kb * 1024 + kMebibyte) << "what was mapped meanwhile";
}

// Page by page, so that every digit is among those that the kernel writes.
TEST(ProcessMemory, IsReadInWhateverDigitsItIsWritten) {
  if (!kHeapTrapCounts) GTEST_SKIP() << "a sanitizer maps memory beside";
  const auto page = static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
  const std::uint64_t before = process_memory().address_space;
  std::vector<void*> mapped;
  for (std::uint64_t i = 1; i <= 30; ++i) {
    mapped.push_back(::mmap(nullptr, page, PROT_READ, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0));
    EXPECT_EQ(process_memory().address_space - before, i * page);
  }
  for (void* const one : mapped) ::munmap(one, page);
}

TEST(ProcessMemory, GrowsInItsAddressSpaceByWhatIsMappedAndInItsOwnByWhatIsWritten) {
  if (!kHeapTrapCounts) GTEST_SKIP() << "a sanitizer maps memory beside";
  const ProcessMemory before = process_memory();
  void* const mapped = ::mmap(nullptr, kMebibyte, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  ASSERT_NE(mapped, MAP_FAILED);
  const ProcessMemory reserved = process_memory();
  *static_cast<volatile unsigned char*>(mapped) = 1;
  const ProcessMemory written = process_memory();
  EXPECT_EQ(reserved.address_space - before.address_space, kMebibyte);
  EXPECT_EQ(written.address_space, reserved.address_space);
  EXPECT_EQ(reserved.anonymous, before.anonymous);
  EXPECT_GT(written.anonymous, reserved.anonymous);
  ::munmap(mapped, kMebibyte);
}

TEST(ThreadNames, BeginWithTheMainThreadsAndHoldTheOthers) {
  std::atomic<bool> is_named{false};
  std::atomic<bool> stop{false};
  std::thread other([&] {
    (void)::pthread_setname_np(::pthread_self(), "journal");
    is_named = true;
    is_named.notify_one();
    stop.wait(false);
  });
  is_named.wait(false);
  const std::vector<std::string> names = thread_names();
  stop = true;
  stop.notify_one();
  other.join();
  ASSERT_EQ(names.size(), 2);
  EXPECT_EQ(names[1], "journal");
}

}  // namespace
}  // namespace earshot::host
