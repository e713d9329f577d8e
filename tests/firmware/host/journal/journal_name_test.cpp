#include "firmware/host/journal/journal_name.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <system_error>

#include "firmware/host/journal/journal_file.hpp"
#include "tests/support/temporary_folder.hpp"

namespace earshot::host {
namespace {

namespace fs = std::filesystem;

TEST(JournalNameTest, IsTheOneThatItWasMadeOf) {
  const fs::path wanted = "out/journal.lcmlog";
  EXPECT_EQ(named(wanted, {}), "out/journal.lcmlog");
  EXPECT_EQ(named(wanted, {.journal = 12, .part = 3}), "out/journal-12.part3.lcmlog");
  for (const JournalName name : {JournalName{}, {.journal = 2}, {.part = 2}, {.journal = 999'999, .part = 999'999}})
    EXPECT_EQ(name_of(wanted, named(wanted, name)), name);
  EXPECT_EQ(part_of("out/journal-2.lcmlog", 3), "out/journal-2.part3.lcmlog");
}

TEST(JournalNameTest, IsNoneOfOtherFiles) {
  for (const char* file :
       {"journal.policy", "journal-1.lcmlog", "journal-02.lcmlog", "journal-.lcmlog", "journal.part1.lcmlog", "journal.part.lcmlog",
        "journal-2x.lcmlog", "journal-1000000.lcmlog", "journal.lcmlog.bak", "my-journal.lcmlog", "journal.part2.part3.lcmlog", ""})
    EXPECT_FALSE(name_of("journal.lcmlog", file)) << file;
}

TEST(JournalNameTest, OfALaterPartLeadsToTheFirst) {
  EXPECT_EQ(first_part_of("sea/journal.part2.lcmlog"), "sea/journal.lcmlog");
  EXPECT_EQ(first_part_of("journal-7.part12.lcmlog"), "journal-7.lcmlog");
  for (const char* file : {"journal.lcmlog", "journal-2.lcmlog", "journal.part1.lcmlog", "journal.part.lcmlog", "journal.part2x.lcmlog",
                           ".part2.lcmlog", "my.partner.lcmlog", ""})
    EXPECT_FALSE(first_part_of(file)) << file;
}

TEST(JournalNameTest, OfTheNewestHasTheHighestNumberAndAFirstPart) {
  const support::TemporaryFolder folder;
  const fs::path wanted = folder / "journal.lcmlog";
  EXPECT_FALSE(newest_journal(wanted));
  EXPECT_TRUE(journals_beside(folder / "none" / "journal.lcmlog").empty());
  for (const char* file : {"journal-7.lcmlog", "journal-10.lcmlog", "journal-12.part2.lcmlog", "notes.txt"})
    std::ofstream(folder / file) << "x";
  EXPECT_EQ(newest_journal(wanted), folder / "journal-10.lcmlog") << "older ones were deleted, and of the twelfth the beginning";
  EXPECT_EQ(journals_beside(wanted).size(), 3U);
}

TEST(JournalNameTest, OfAFolderIsThatOfTheNewestJournalInIt) {
  const support::TemporaryFolder folder;
  EXPECT_EQ(newest_journal_in(folder.path()), folder / "journal.lcmlog") << "which is to be made";
  std::ofstream(folder / "journal-7.lcmlog") << "x";
  EXPECT_EQ(newest_journal_in(folder.path()), folder / "journal-7.lcmlog");
  std::ofstream(folder / "journal.lcmlog") << "x";
  EXPECT_EQ(newest_journal_in(folder.path()), folder / "journal-7.lcmlog");
  EXPECT_EQ(newest_journal_in(folder / "journal-7.lcmlog"), folder / "journal-7.lcmlog");
}

TEST(JournalNameTest, IsGivenToNoFileThatWouldNotBeFoundByIt) {
  const support::TemporaryFolder folder;
  const fs::path wanted = folder / "journal.lcmlog";
  std::ofstream(folder / "journal-999999.lcmlog") << "x";
  EXPECT_THROW(JournalFile(wanted, ExistingJournal::kKeep), std::system_error);
  EXPECT_EQ(journals_beside(wanted).size(), 1U);
  EXPECT_FALSE(fs::exists(folder / "journal-1000000.lcmlog"));
}

}  // namespace
}  // namespace earshot::host
