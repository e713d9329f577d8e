#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

#include "firmware/host/memory/heap_trap.hpp"
#include "tests/firmware/host/journal/journal_folder.hpp"

namespace earshot::host {
namespace {

namespace fs = std::filesystem;

using JournalHeap = JournalFolder;

TEST_F(JournalHeap, IsNotTouchedByAnyThreadWhilePartsAreBegunAndOlderJournalsAreDeleted) {
  for (const char* name : {"journal.lcmlog", "journal.part2.lcmlog", "journal-2.lcmlog"})
    std::ofstream(folder_ / name, std::ios::binary) << "\xED\xA1\xDA\x01" << std::string(150'000, 'x');
  Journal journal(path_, {.existing = ExistingJournal::kKeep, .limits = {.part_bytes = 100'000, .budget_bytes = 800'000}});
  const Bytes data(1'000);
  std::uint64_t taken = 0;
  arm_heap_trap();
  for (int i = 0; i < 600; ++i) {
    taken += journal.append(Time{i}, "STREAM", data) == Status::kOk ? 1U : 0U;
    (void)journal.flush();
  }
  disarm_heap_trap();
  EXPECT_TRUE(heap_uses().empty()) << to_string(heap_uses().front());
  EXPECT_EQ(taken, 600U);
  EXPECT_EQ(journal.counters().deleted, 2U);
  EXPECT_TRUE(fs::exists(folder_ / "journal-3.part5.lcmlog"));
}

}  // namespace
}  // namespace earshot::host
