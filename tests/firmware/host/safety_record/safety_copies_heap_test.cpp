#include <gtest/gtest.h>

#include <chrono>
#include <vector>

#include "firmware/host/memory/heap_trap.hpp"
#include "firmware/host/safety_record/safety_copies.hpp"
#include "tests/firmware/host/safety_record/some_record.hpp"
#include "tests/support/temporary_folder.hpp"

namespace earshot::host {
namespace {

TEST(SafetyCopiesHeap, IsNotTouchedByAnyThreadWhateverACopyTakes) {
  const support::TemporaryFolder folder;
  SafetyCopies copies({{.file = folder / "one"}, {.file = folder / "missing" / "two"}});
  copies.prepare(std::vector<std::uint8_t>(100));
  arm_heap_trap();
  for (int i = 0; i < 30; ++i) (void)copies.write(some_record(0), std::chrono::milliseconds(20));
  disarm_heap_trap();
  EXPECT_TRUE(heap_uses().empty()) << to_string(heap_uses().front());
}

}  // namespace
}  // namespace earshot::host
