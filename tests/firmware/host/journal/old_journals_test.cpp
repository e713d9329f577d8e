#include "firmware/host/journal/old_journals.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>

#include "firmware/host/journal/journal_name.hpp"
#include "firmware/wire/lcm/channels.hpp"
#include "tests/firmware/host/journal/journal_folder.hpp"

namespace earshot::host {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kKibibyte = 1024;

class OldJournalsTest : public JournalFolder {
 protected:
  /// A file that begins as a journal does.
  void make(const std::string& name, std::size_t bytes) const {
    std::ofstream(folder_ / name, std::ios::binary) << "\xED\xA1\xDA\x01" << std::string(bytes - 4, 'x');
  }
  [[nodiscard]] bool is_there(const std::string& name) const { return fs::exists(fs::symlink_status(folder_ / name)); }
};

TEST_F(OldJournalsTest, AreDeletedWholeTheOldestFirst) {
  make("journal.lcmlog", 100);
  make("journal.part2.lcmlog", 50);
  make("journal-2.lcmlog", 30);
  make("journal-10.lcmlog", 20);
  make("journal-11.lcmlog", 1000);
  std::ofstream(folder_ / "journal.policy") << "EARSHOTP and so on";
  std::ofstream(folder_ / "journal-2.policy") << "EARSHOTP and so on";
  std::ofstream(folder_ / "journal.tables") << "EARSHOTT and so on";
  std::ofstream(folder_ / "journal-2.tables") << "EARSHOTT and so on";
  OldJournals old(path_, 11);
  EXPECT_EQ(old.bytes(), 200U);
  EXPECT_TRUE(old.delete_oldest());
  EXPECT_EQ(old.bytes(), 50U);
  for (const char* name : {"journal.lcmlog", "journal.part2.lcmlog", "journal.policy", "journal.tables"})
    EXPECT_FALSE(is_there(name)) << name;
  EXPECT_TRUE(is_there("journal-2.policy"));
  EXPECT_TRUE(is_there("journal-2.tables"));
  EXPECT_TRUE(old.delete_oldest());
  EXPECT_FALSE(is_there("journal-2.lcmlog")) << "2 before 10";
  EXPECT_TRUE(old.delete_oldest());
  EXPECT_FALSE(old.delete_oldest());
  EXPECT_EQ(old.deleted(), 3U);
  EXPECT_EQ(old.last_deleted(), 10);
  EXPECT_TRUE(is_there("journal-11.lcmlog")) << "it is written now";
}

TEST_F(OldJournalsTest, AreNeitherOtherFilesNorLinksNorFoldersNorPipes) {
  std::ofstream(folder_ / "journal.lcmlog") << "notes of somebody who likes this name";
  fs::create_symlink("elsewhere.lcmlog", folder_ / "journal-2.lcmlog");
  make("elsewhere.lcmlog", 100);
  fs::create_directory(folder_ / "journal-3.lcmlog");
  ASSERT_EQ(::mkfifo((folder_ / "journal-4.lcmlog").c_str(), 0600), 0);
  OldJournals old(path_, 5);
  EXPECT_EQ(old.bytes(), 0U);
  EXPECT_FALSE(old.delete_oldest());
  for (const char* name : {"journal.lcmlog", "journal-2.lcmlog", "elsewhere.lcmlog", "journal-3.lcmlog", "journal-4.lcmlog"})
    EXPECT_TRUE(is_there(name)) << name;
}

TEST_F(OldJournalsTest, AreNotDeletedWhileAnotherProcessWritesThem) {
  const Journal other(path_);
  make("journal-2.lcmlog", 10);
  OldJournals old(path_, 3);
  EXPECT_TRUE(old.delete_oldest());
  EXPECT_TRUE(is_there("journal.lcmlog"));
  EXPECT_FALSE(is_there("journal-2.lcmlog"));
}

TEST_F(OldJournalsTest, CountNoMoreOnceSomebodyTookThemAway) {
  make("journal.lcmlog", 400);
  make("journal.part2.lcmlog", 100);
  make("journal-2.lcmlog", 300);
  OldJournals old(path_, 3);
  fs::remove(path_);
  fs::remove(folder_ / "journal.part2.lcmlog");
  EXPECT_TRUE(old.delete_oldest());
  EXPECT_EQ(old.bytes(), 300U);
  EXPECT_EQ(old.deleted(), 0U);
  EXPECT_TRUE(is_there("journal-2.lcmlog")) << "there may be room enough now";
}

TEST_F(OldJournalsTest, AreNotWhatSomebodyPutInTheirPlaceOrBesideThem) {
  make("journal.lcmlog", 400);
  std::ofstream(folder_ / "journal.policy") << "what I think of this policy";
  make("journal-2.lcmlog", 300);
  OldJournals old(path_, 3);
  std::ofstream(path_) << "notes";
  fs::remove(folder_ / "journal-2.lcmlog");
  make("elsewhere.lcmlog", 300);
  fs::create_symlink("elsewhere.lcmlog", folder_ / "journal-2.lcmlog");
  while (old.delete_oldest()) {
  }
  EXPECT_EQ(old.deleted(), 0U);
  for (const char* name : {"journal.lcmlog", "journal.policy", "journal-2.lcmlog", "elsewhere.lcmlog"}) EXPECT_TRUE(is_there(name)) << name;
}

TEST_F(OldJournalsTest, AreDeletedForAJournalThatIsGoneOnWith) {
  make("journal.lcmlog", 900 * kKibibyte);
  const fs::path second = folder_ / "journal-2.lcmlog";
  { ASSERT_EQ(Journal(second).append(Time{1}, "X", Bytes(71)), Status::kOk); }
  JournalFile file(second, ExistingJournal::kGoOn);
  file.cut(100);
  file.count_among(path_);
  const Journal journal(std::move(file), 1, {.limits = {.part_bytes = 0, .budget_bytes = 1000 * kKibibyte}});
  EXPECT_FALSE(is_there("journal.lcmlog")) << "900 and the 128 that are held for it are more than 1000";
}

TEST_F(OldJournalsTest, LeaveRoomForEveryOrderThoughTheBudgetEndsWhereAPartIsDue) {
  constexpr std::uint64_t kBudget = 600'000;
  constexpr int kOrders = 150;
  {
    Journal journal(path_, {.limits = {.part_bytes = 100'000, .budget_bytes = kBudget}});
    for (int i = 0; i < 20 * kOrders; ++i) {
      (void)journal.append(Time{i}, "STREAM", Bytes(400));
      if (i % 20 == 0) {
        EXPECT_EQ(journal.append(Time{i}, "ORDER", Bytes(20), Priority::kOrder), Status::kOk);
      }
      if (i % 50 == 0) (void)journal.flush(std::chrono::milliseconds(5));
    }
    journal.conclude({});
    (void)journal.close();
    EXPECT_GT(of(journal.counters().lost, Priority::kStream), 0U);
  }
  std::uint64_t bytes = 0;
  for (const auto& file : fs::directory_iterator(folder_.path())) bytes += file.file_size();
  EXPECT_LE(bytes, kBudget);
  EXPECT_TRUE(is_there("journal.part2.lcmlog"));
  JournalReader reader(path_);
  int orders = 0;
  for (JournalRecord record; reader.next(record);) orders += record.channel == "ORDER" ? 1 : 0;
  EXPECT_EQ(orders, kOrders);
  EXPECT_TRUE(reader.damages().empty());
}

TEST_F(OldJournalsTest, AreDeletedForTheBudgetWhenAJournalGrowsAndThenTheDiskIsAsGoodAsFull) {
  make("journal.lcmlog", 200 * kKibibyte);
  make("journal-2.lcmlog", 200 * kKibibyte);
  Journal journal(path_, {.existing = ExistingJournal::kKeep, .limits = {.part_bytes = 0, .budget_bytes = 600 * kKibibyte}});
  EXPECT_EQ(journal.path(), folder_ / "journal-3.lcmlog");
  const auto append = [&](int kibibytes) {
    for (int i = 0; i < kibibytes; ++i) (void)journal.append(Time{i}, "X", Bytes(kKibibyte - 29));
    return journal.flush();
  };
  ASSERT_EQ(append(50), Status::kOk);
  EXPECT_TRUE(is_there("journal.lcmlog"));
  ASSERT_EQ(append(150), Status::kOk);
  EXPECT_FALSE(is_there("journal.lcmlog"));
  EXPECT_TRUE(is_there("journal-2.lcmlog"));
  ASSERT_EQ(append(200), Status::kOk);
  EXPECT_FALSE(is_there("journal-2.lcmlog"));
  EXPECT_EQ(journal.counters().deleted, 2U);
  EXPECT_EQ(append(300), Status::kNotReady) << "700 kB are more than 600";
  EXPECT_EQ(journal.trouble(), JournalTrouble::kTakesNothing);
  ASSERT_EQ(journal.append(Time{1}, "ORDER", Bytes{1}, Priority::kOrder), Status::kOk);
  journal.conclude({});
  (void)journal.close();
  EXPECT_LE(fs::file_size(journal.path()), 600 * kKibibyte);
  JournalReader reader(journal.path());
  bool has_order = false;
  std::string last;
  for (JournalRecord record; reader.next(record); last = record.channel) has_order = has_order || record.channel == "ORDER";
  EXPECT_TRUE(has_order);
  EXPECT_EQ(last, wire::kJournalEndChannel);
}

}  // namespace
}  // namespace earshot::host
