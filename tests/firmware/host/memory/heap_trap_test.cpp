#include "firmware/host/memory/heap_trap.hpp"

#include <gtest/gtest.h>
#include <malloc.h>
#include <pthread.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <new>
#include <ostream>
#include <set>
#include <string>
#include <thread>

#include "tests/support/text/tells.hpp"

namespace earshot::host {
namespace {

/// What is written here is looked at by nobody, but the compiler cannot know: it may leave out an allocation whose result is not used.
void* volatile kept = nullptr;

void keep(void* memory) {
  kept = memory;
}

struct alignas(256) Wide {
  std::array<std::byte, 256> bytes;
};

/// One way to the heap, called once while the trap is armed.
struct Way {
  const char* name;
  void (*go)();
  std::uint64_t allocations;
  std::uint64_t releases;
  std::uint64_t mappings = 0;
};

void PrintTo(const Way& way, std::ostream* stream) {
  *stream << way.name;
}

void make_and_free(void* memory) {
  keep(memory);
  std::free(memory);
}

// By hand: each makes once and frees once, but where it says something else.
const Way kWays[] = {
    {"Malloc", [] { make_and_free(std::malloc(8)); }, 1, 1},
    {"Calloc", [] { make_and_free(std::calloc(2, 4)); }, 1, 1},
    {"Realloc", [] { make_and_free(std::realloc(nullptr, 8)); }, 1, 1},
    {"Reallocarray", [] { make_and_free(::reallocarray(nullptr, 2, 4)); }, 1, 1},
    {"AlignedAlloc", [] { make_and_free(std::aligned_alloc(64, 64)); }, 1, 1},
    {"Memalign", [] { make_and_free(::memalign(64, 64)); }, 1, 1},
    {"PosixMemalign",
     [] {
       void* memory = nullptr;
       EXPECT_EQ(::posix_memalign(&memory, 64, 64), 0);
       make_and_free(memory);
     },
     1, 1},
    {"Valloc", [] { make_and_free(::valloc(8)); }, 1, 1},
    {"Strdup", [] { make_and_free(::strdup("eight!!")); }, 1, 1},
    {"New",
     [] {
       auto* const made = new int(1);
       keep(made);
       delete made;
     },
     1, 1},
    {"NewArray",
     [] {
       auto* const made = new int[4];
       keep(made);
       delete[] made;
     },
     1, 1},
    {"NewThatDoesNotThrow",
     [] {
       auto* const made = new (std::nothrow) int(1);
       keep(made);
       delete made;
     },
     1, 1},
    {"AlignedNew",
     [] {
       auto* const made = new Wide;
       keep(made);
       delete made;
     },
     1, 1},
    {"AlignedNewArray",
     [] {
       auto* const made = new Wide[2];
       keep(made);
       delete[] made;
     },
     1, 1},
    {"AlignedNewThatDoesNotThrow",
     [] {
       auto* const made = new (std::nothrow) Wide;
       keep(made);
       delete made;
     },
     1, 1},
    {"Exception",
     [] {
       try {
         throw 1;  // the runtime library takes room for it from the heap
       } catch (int) {
       }
     },
     1, 1},
    {"MapOfMemory",
     [] {
       void* const mapped = ::mmap(nullptr, 4096, PROT_READ, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
       EXPECT_NE(mapped, MAP_FAILED);
       EXPECT_EQ(::munmap(mapped, 4096), 0);
     },
     0, 0, 1},
    {"Sbrk", [] { keep(::sbrk(4096)); }, 0, 0, 1},
    {"FreeOfNothing", [] { std::free(nullptr); }, 0, 0},
    {"QuestionWhereTheHeapEnds", [] { keep(::sbrk(0)); }, 0, 0},
    {"Nothing", [] {}, 0, 0},
};

class EveryWayToTheHeap : public testing::TestWithParam<Way> {
 protected:
  void SetUp() override {
    if (!kHeapTrapCounts) GTEST_SKIP() << "a sanitizer's heap is not counted";
  }
};

TEST_P(EveryWayToTheHeap, IsCounted) {
  arm_heap_trap();
  GetParam().go();
  disarm_heap_trap();
  HeapUse use;
  if (!heap_uses().empty()) use = heap_uses().front();
  EXPECT_EQ(use.allocations, GetParam().allocations);
  EXPECT_EQ(use.releases, GetParam().releases);
  EXPECT_EQ(use.mappings, GetParam().mappings);
  EXPECT_EQ(heap_uses().size(), GetParam().allocations + GetParam().mappings > 0 ? 1 : 0);
}

INSTANTIATE_TEST_SUITE_P(HeapTrap, EveryWayToTheHeap, testing::ValuesIn(kWays), [](const auto& way) { return way.param.name; });

TEST(HeapTrapMappings, AreThoseThatWereAskedFor) {
  const auto page = static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
  void* const mapped = ::mmap(nullptr, page, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  ASSERT_NE(mapped, MAP_FAILED);
  *static_cast<volatile char*>(mapped) = 1;
  EXPECT_EQ(::munmap(mapped, page), 0);
}

TEST(HeapTrapMappings, OfAFileBeginWhereTheyWereAskedToBeyondFourGigabytesToo) {
  const auto page = static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
  const int file = ::memfd_create("sparse", MFD_CLOEXEC);
  ASSERT_GE(file, 0);
  for (const off64_t begin : {off64_t{0}, static_cast<off64_t>(page), (off64_t{1} << 32) + static_cast<off64_t>(page)}) {
    const char mark = 'x';
    ASSERT_EQ(::pwrite64(file, &mark, 1, begin), 1);
    void* const mapped = ::mmap64(nullptr, page, PROT_READ, MAP_SHARED, file, begin);
    ASSERT_NE(mapped, MAP_FAILED) << begin;
    EXPECT_EQ(*static_cast<const char*>(mapped), 'x') << begin;
    EXPECT_EQ(::munmap(mapped, page), 0);
    errno = 0;
    EXPECT_EQ(::mmap64(nullptr, page, PROT_READ, MAP_SHARED, file, begin + 1), MAP_FAILED) << "no page begins there";
    EXPECT_EQ(errno, EINVAL);
    ASSERT_EQ(::ftruncate(file, 0), 0);
  }
  EXPECT_EQ(::close(file), 0);
}

TEST(HeapTrapRefusals, OfTheReplacedFunctionsAreThoseOfTheOriginals) {
  if (!kHeapTrapCounts) GTEST_SKIP() << "a sanitizer's heap is not counted";
  void* memory = nullptr;
  EXPECT_EQ(::posix_memalign(&memory, 24, 64), EINVAL) << "no power of two";
  EXPECT_EQ(::posix_memalign(&memory, 4, 64), EINVAL) << "below a pointer's";
  EXPECT_EQ(::posix_memalign(&memory, 0, 64), EINVAL) << "none";
  ASSERT_EQ(::posix_memalign(&memory, 65'536, 24), 0);
  EXPECT_EQ(reinterpret_cast<std::uintptr_t>(memory) % 65'536, 0U);
  std::free(memory);
  const volatile std::size_t half = std::size_t{1} << 63U;
  errno = 0;
  EXPECT_EQ(::reallocarray(nullptr, half, 2), nullptr) << "2^64";
  EXPECT_EQ(errno, ENOMEM);
}

TEST(HeapTrapThreads, AreToldApartByTheirNamesAndEachByItsOwnCount) {
  if (!kHeapTrapCounts) GTEST_SKIP() << "a sanitizer's heap is not counted";
  pthread_barrier_t barrier;
  ASSERT_EQ(::pthread_barrier_init(&barrier, nullptr, 2), 0);
  std::thread other([&barrier] {
    (void)::pthread_setname_np(::pthread_self(), "writer");
    ::pthread_barrier_wait(&barrier);  // armed
    for (int i = 0; i < 3; ++i) make_and_free(std::malloc(100));
    ::pthread_barrier_wait(&barrier);  // to be disarmed
    ::pthread_barrier_wait(&barrier);
  });
  arm_heap_trap();
  ::pthread_barrier_wait(&barrier);
  ::pthread_barrier_wait(&barrier);
  disarm_heap_trap();
  ::pthread_barrier_wait(&barrier);
  other.join();
  ASSERT_EQ(heap_uses().size(), 1);
  EXPECT_STREQ(heap_uses()[0].name.data(), "writer");
  EXPECT_EQ(heap_uses()[0].allocations, 3);
  EXPECT_EQ(heap_uses()[0].bytes, 300);
  EXPECT_TRUE(support::has_line(to_string(heap_uses()[0]), {"3 allocations", "3 releases", "0 mappings", "300 bytes", "within"}))
      << to_string(heap_uses()[0]);
  const std::string text = to_string(heap_uses()[0]);
  ASSERT_GT(heap_uses()[0].first_count, 1);
  EXPECT_EQ(std::ranges::count(text, '\n'), static_cast<std::ptrdiff_t>(heap_uses()[0].first_count)) << "a line for each caller";
}

TEST(HeapUse, IsSpelledWithItsCallersIfAnyAreKnown) {
  HeapUse use;
  EXPECT_EQ(to_string(use).find("from within"), std::string::npos);
  use.first_count = 1;
  EXPECT_NE(to_string(use).find("; the first, from within:\n    "), std::string::npos) << to_string(use);
}

TEST(HeapTrapThreads, BeyondThoseForWhichThereIsRoomAreCountedTogether) {
  if (!kHeapTrapCounts) GTEST_SKIP() << "a sanitizer's heap is not counted";
  arm_heap_trap();
  for (int i = 0; i < 70; ++i) std::thread([] { make_and_free(std::malloc(1'000'000)); }).join();
  disarm_heap_trap();
  std::uint64_t bytes = 0;
  for (const HeapUse& use : heap_uses()) bytes += use.bytes;
  EXPECT_EQ(heap_uses().size(), 65);
  std::set<int> threads;
  for (const HeapUse& use : heap_uses()) threads.insert(use.thread);
  EXPECT_EQ(threads.size(), 65) << "none twice";
  EXPECT_EQ(heap_uses().back().thread, 0);
  EXPECT_GE(bytes, 70'000'000);
}

TEST(HeapTrapArmedAnew, CountsFromZero) {
  if (!kHeapTrapCounts) GTEST_SKIP() << "a sanitizer's heap is not counted";
  arm_heap_trap();
  make_and_free(std::malloc(8));
  arm_heap_trap();
  disarm_heap_trap();
  make_and_free(std::malloc(8));
  EXPECT_TRUE(heap_uses().empty());
}

}  // namespace
}  // namespace earshot::host
