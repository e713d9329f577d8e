#include <array>

#include "firmware/host/memory/heap_trap.hpp"
#include "tests/firmware/host/transport/can_bus.hpp"

namespace earshot::host {
namespace {

using CanSocketHeap = CanBusTest;

/// Calls of the heap by this program while `work` runs.
template <class Work>
std::uint64_t heap_calls_of(const Work& work) {
  arm_heap_trap();
  work();
  disarm_heap_trap();
  std::uint64_t calls = 0;
  for (const HeapUse& use : heap_uses()) calls += use.allocations + use.releases + use.mappings;
  return calls;
}

TEST_F(CanSocketHeap, TheTrapSeesAnAllocation) {
  EXPECT_GT(heap_calls_of([] { delete new volatile int(1); }), 0U);
}

TEST_F(CanSocketHeap, NothingAllocatesOnceItIsMade) {
  CanOptions options;
  ASSERT_EQ(filters_for(std::array<std::uint32_t, 1>{127250}, options.filters), Status::kOk);
  CanSocket alice(kBus);
  CanSocket bob(kBus, IfMissing::kRefuse, options);
  const std::array<n2k::Frame, 2> group{heading_frame(1), heading_frame(2)};
  unsigned done = 0;
  EXPECT_EQ(heap_calls_of([&] {
              done += alice.send(heading_frame(0)) == Status::kOk ? 1U : 0U;
              done += alice.send_whole(group, Time{}) == Status::kOk ? 1U : 0U;
              alice.flush(Time{1'000});
              for (n2k::Frame frame; more_comes(bob) && bob.receive(frame) == Status::kOk;) ++done;
              done += bob.set_filters(options.filters) ? 1U : 0U;
              done += bob.reopen() ? 1U : 0U;
              done += bob.counters().received == 3 ? 1U : 0U;
            }),
            0U);
  EXPECT_EQ(done, 2U + 3U + 3U) << "it all was done";
}

TEST_F(CanSocketHeap, NothingAllocatesWhileTheInterfaceComesAndGoes) {
  CanSocket bob(kBus);
  ASSERT_TRUE(iproute("ip link set vcan91 down"));
  bool is_up = true;
  EXPECT_EQ(heap_calls_of([&] {
              (void)bob.send_whole(std::array{heading_frame(1)}, Time{});
              n2k::Frame frame;
              (void)bob.receive(frame);
              is_up = bob.reopen();
            }),
            0U);
  EXPECT_FALSE(is_up);
  ASSERT_TRUE(iproute("ip link set vcan91 up"));
  EXPECT_EQ(heap_calls_of([&] { is_up = bob.reopen(); }), 0U);
  EXPECT_TRUE(is_up);
}

}  // namespace
}  // namespace earshot::host
