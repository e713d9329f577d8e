#include "firmware/host/safety_record/safety_copies.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "firmware/core/crc32.hpp"
#include "firmware/host/safety_record/record_file.hpp"
#include "tests/firmware/host/safety_record/some_record.hpp"
#include "tests/support/small_disk.hpp"
#include "tests/support/temporary_folder.hpp"

namespace earshot::host {
namespace {

namespace fs = std::filesystem;
using std::chrono::milliseconds;

constexpr milliseconds kPatient{10'000};  // a disk of ours takes it sooner, however busy this machine is

class SafetyCopiesTest : public testing::Test {
 protected:
  [[nodiscard]] std::vector<SafetyCopy> copies() const {
    return {{.file = one_}, {.file = two_}, {.file = memory_, .survives_power_cut = false}};
  }
  [[nodiscard]] static SafetyRecord record(std::uint64_t turn) {
    SafetyRecord record = some_record(0);
    record.turn = turn;
    record.kept_crc32 = crc32(kKept);
    return record;
  }
  [[nodiscard]] static std::uint64_t turn_in(const fs::path& path) {
    RecordFile file(path);
    return file.open() ? file.newest().value_or(SafetyRecord{}).turn : 0;
  }

  inline static const std::vector<std::uint8_t> kKept{5, 4, 3};
  const support::TemporaryFolder folder_;
  const fs::path one_ = folder_ / "one";
  const fs::path two_ = folder_ / "two";
  const fs::path memory_ = folder_ / "memory";
};

TEST_F(SafetyCopiesTest, AllHoldTheRecordThatTheNextProcessFinds) {
  {
    SafetyCopies copies(this->copies());
    EXPECT_FALSE(copies.found());
    copies.prepare(kKept);
    EXPECT_TRUE(copies.write(record(1), kPatient));
    EXPECT_TRUE(copies.write(record(2), kPatient));
    EXPECT_TRUE(copies.is_durable());
  }
  for (const fs::path& path : {one_, two_, memory_}) EXPECT_EQ(turn_in(path), 2U) << path;
  SafetyCopies next(copies());
  ASSERT_TRUE(next.found());
  EXPECT_EQ(next.found()->turn, 2U);
  EXPECT_EQ(next.kept(), kKept);
  EXPECT_TRUE(next.write(record(3), kPatient));
}

TEST_F(SafetyCopiesTest, TheNewestOfThemCountsWhicheverItIsAndADamagedOneIsNoneOfThem) {
  {
    SafetyCopies copies({{.file = one_}});
    copies.prepare(kKept);
    EXPECT_TRUE(copies.write(record(1), kPatient));
  }
  fs::copy_file(one_, two_);
  {
    SafetyCopies copies({{.file = two_}});
    EXPECT_TRUE(copies.write(record(2), kPatient));
  }
  EXPECT_EQ(SafetyCopies(copies()).found()->turn, 2U);
  fs::resize_file(two_, 0);
  EXPECT_EQ(SafetyCopies(copies()).found()->turn, 1U);
  EXPECT_EQ(SafetyCopies(copies()).kept(), kKept);
}

TEST_F(SafetyCopiesTest, SaysThatItIsNotDurableWhereOnlyMemoryTakesItAndTriesAgain) {
  SafetyCopies copies({{.file = folder_ / "not yet there" / "one"}, {.file = memory_, .survives_power_cut = false}});
  copies.prepare(kKept);
  EXPECT_FALSE(copies.write(record(1), milliseconds(200)));
  EXPECT_EQ(turn_in(memory_), 1U) << "a crash does not reach memory";
  EXPECT_EQ(copies.complaints(), (folder_ / "not yet there" / "one").string());
  fs::create_directory(folder_ / "not yet there");
  const auto deadline = std::chrono::steady_clock::now() + kPatient;
  while (!copies.is_durable() && std::chrono::steady_clock::now() < deadline) std::this_thread::sleep_for(milliseconds(10));
  EXPECT_TRUE(copies.is_durable());
  EXPECT_EQ(turn_in(folder_ / "not yet there" / "one"), 1U);
}

TEST_F(SafetyCopiesTest, AFlightThatGoesOnIsDurableAgainOnceItsReadOnlyDiskIsWritable) {
  const std::unique_ptr<support::SmallDisk> disk = support::SmallDisk::make(256 * 1024);
  if (!disk) GTEST_SKIP() << "this kernel lets only root mount a file system";
  const fs::path path = disk->path() / "journal.safety";
  {
    SafetyCopies copies({{.file = path}});
    copies.prepare(kKept);
    ASSERT_TRUE(copies.write(record(1), kPatient));
  }
  ASSERT_TRUE(disk->set_read_only(true));
  SafetyCopies copies({{.file = path}});
  EXPECT_FALSE(copies.write(record(2), milliseconds(200)));
  ASSERT_TRUE(disk->set_read_only(false));
  const auto deadline = std::chrono::steady_clock::now() + kPatient;
  while (!copies.is_durable() && std::chrono::steady_clock::now() < deadline) std::this_thread::sleep_for(milliseconds(10));
  EXPECT_TRUE(copies.is_durable());
  EXPECT_EQ(turn_in(path), 2U);
}

TEST_F(SafetyCopiesTest, GivesUpItsLastCopiesForWhoNeedsADescriptorButNotTheFirst) {
  SafetyCopies copies(this->copies());
  copies.prepare(kKept);
  ASSERT_TRUE(copies.write(record(1), kPatient));
  EXPECT_TRUE(copies.give_up_one());
  EXPECT_TRUE(copies.give_up_one());
  EXPECT_FALSE(copies.give_up_one());
  EXPECT_TRUE(copies.write(record(2), kPatient));
  EXPECT_EQ(turn_in(one_), 2U);
  EXPECT_EQ(turn_in(two_), 1U);
  EXPECT_EQ(copies.complaints(), two_.string() + ", " + memory_.string());
}

TEST_F(SafetyCopiesTest, RefusesToBeASecondOwner) {
  const SafetyCopies copies(this->copies());
  EXPECT_NO_THROW(SafetyCopies{this->copies()}) << "there is no file yet";
  SafetyCopies first(this->copies());
  first.prepare(kKept);
  EXPECT_THROW(SafetyCopies{this->copies()}, RecordInUse);
}

TEST_F(SafetyCopiesTest, AFileThatIsRemovedReplacedOrCutInFlightIsMadeAnewWithAllThatIsKept) {
  SafetyCopies copies({{.file = one_}});
  copies.prepare(kKept);
  ASSERT_TRUE(copies.write(record(1), kPatient));
  fs::remove(one_);
  EXPECT_TRUE(copies.write(record(2), kPatient));
  EXPECT_EQ(turn_in(one_), 2U);
  fs::copy_file(one_, two_);
  fs::rename(two_, one_);
  EXPECT_TRUE(copies.write(record(3), kPatient));
  EXPECT_EQ(turn_in(one_), 3U);
  fs::resize_file(one_, 0);
  EXPECT_TRUE(copies.write(record(4), kPatient));
  RecordFile file(one_);
  ASSERT_TRUE(file.open());
  EXPECT_EQ(file.newest().value_or(SafetyRecord{}).turn, 4U);
  EXPECT_EQ(file.kept(crc32(kKept)), kKept);
}

TEST_F(SafetyCopiesTest, AFlightThatGoesOnMakesTheCopyAnewThatIsGone) {
  {
    SafetyCopies copies(this->copies());
    copies.prepare(kKept);
    ASSERT_TRUE(copies.write(record(1), kPatient));
  }
  fs::remove(one_);
  {
    SafetyCopies copies(this->copies());
    ASSERT_TRUE(copies.write(record(2), kPatient));
  }
  EXPECT_EQ(turn_in(one_), 2U);
}

TEST_F(SafetyCopiesTest, AStaleCopyOfAnEarlierFlightDoesNotCountHoweverHighItsNumbersAre) {
  {
    SafetyCopies copies({{.file = two_}});
    copies.prepare(kKept);
    SafetyRecord closed = record(100);
    closed.journal_crc32 = 1;
    closed.is_closed = true;
    for (int i = 0; i < 9; ++i) ASSERT_TRUE(copies.write(closed, kPatient));
  }
  {
    SafetyCopies copies({{.file = one_}});
    copies.prepare(kKept);
    SafetyRecord later = record(2);
    later.since_boot = later.since_boot + Duration::seconds(100);
    ASSERT_TRUE(copies.write(later, kPatient));
  }
  SafetyCopies copies(this->copies());
  ASSERT_TRUE(copies.found());
  EXPECT_EQ(copies.found()->turn, 2U);
}

TEST_F(SafetyCopiesTest, ARecordOfAnotherVehicleIsLeftOutAndSaid) {
  const RecordOwner theirs{.computer = 1, .folder = 2};
  {
    SafetyCopies copies({{.file = one_}}, theirs);
    copies.prepare(kKept);
    ASSERT_TRUE(copies.write(record(1), kPatient));
  }
  SafetyCopies ours({{.file = one_}}, {.computer = 1, .folder = 3});
  EXPECT_FALSE(ours.found());
  ASSERT_EQ(ours.left_out().size(), 1U);
  EXPECT_NE(ours.left_out()[0].find("of another vehicle"), std::string::npos);
  EXPECT_TRUE(SafetyCopies({{.file = one_}}, theirs, Claim::kWaived).found());
}

TEST_F(SafetyCopiesTest, WhoWaivesTheClaimTakesTheFlightOverAndTheOtherHearsOfIt) {
  SafetyCopies hung({{.file = one_}});
  hung.prepare(kKept);
  ASSERT_TRUE(hung.write(record(1), kPatient));
  SafetyCopies other({{.file = one_}}, {}, Claim::kWaived);
  ASSERT_TRUE(other.found());
  EXPECT_TRUE(other.write(record(2), kPatient));
  EXPECT_FALSE(hung.is_overtaken());
  EXPECT_FALSE(hung.write(record(3), milliseconds(500)));
  EXPECT_TRUE(hung.is_overtaken());
  EXPECT_FALSE(other.is_overtaken());
  EXPECT_EQ(turn_in(one_), 2U);
}

TEST_F(SafetyCopiesTest, TheNewestIsTheOneThatWasGivenLast) {
  SafetyCopies copies({{.file = one_}});
  EXPECT_FALSE(copies.newest());
  copies.prepare(kKept);
  ASSERT_TRUE(copies.write(record(8), kPatient));
  EXPECT_FALSE(copies.found());
  ASSERT_TRUE(copies.newest());
  EXPECT_EQ(copies.newest()->turn, 8U);
}

}  // namespace
}  // namespace earshot::host
