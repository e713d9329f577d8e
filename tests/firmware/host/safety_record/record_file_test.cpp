#include "firmware/host/safety_record/record_file.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "firmware/core/crc32.hpp"
#include "tests/firmware/host/safety_record/some_record.hpp"
#include "tests/support/small_disk.hpp"
#include "tests/support/temporary_folder.hpp"

namespace earshot::host {
namespace {

namespace fs = std::filesystem;
using Bytes = std::vector<std::uint8_t>;

const Bytes kKept{1, 2, 3, 4, 5};

Bytes bytes_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void put(const fs::path& path, const Bytes& bytes) {
  std::ofstream(path, std::ios::binary).write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
}

class RecordFileTest : public testing::Test {
 protected:
  /// @return the newest record of the file, as a new process reads it
  [[nodiscard]] std::optional<SafetyRecord> read() const {
    RecordFile file(path_);
    return file.open() ? file.newest() : std::nullopt;
  }

  const support::TemporaryFolder folder_;
  const fs::path path_ = folder_ / "journal.safety";
};

TEST_F(RecordFileTest, HoldsTheNewestRecordAndWhatIsKeptBesideIt) {
  RecordFile file(path_);
  EXPECT_FALSE(file.open());
  ASSERT_TRUE(file.prepare(kKept));
  EXPECT_FALSE(read());
  for (std::uint64_t sequence = 1; sequence <= 5; ++sequence) {
    ASSERT_TRUE(file.write(some_record(sequence)));
    EXPECT_EQ(read(), some_record(sequence));
  }
  EXPECT_EQ(fs::file_size(path_), kRecordFileBytes);
  EXPECT_EQ(file.kept(crc32(kKept)), kKept);
  EXPECT_EQ(file.kept(crc32(kKept) + 1), Bytes());
}

TEST_F(RecordFileTest, AWriteThatIsCutOffAnywhereLeavesTheRecordBefore) {
  RecordFile file(path_);
  ASSERT_TRUE(file.prepare(kKept));
  ASSERT_TRUE(file.write(some_record(1)));
  const Bytes before = bytes_of(path_);
  ASSERT_TRUE(file.write(some_record(2)));
  const Bytes after = bytes_of(path_);
  // They differ in the second slot alone, from its beginning on.
  for (std::size_t size = kRecordSlotBytes; size <= kRecordSlotBytes + kSafetyRecordBytes; ++size) {
    Bytes torn = after;
    std::copy(before.begin() + static_cast<std::ptrdiff_t>(size), before.end(), torn.begin() + static_cast<std::ptrdiff_t>(size));
    put(path_, torn);
    EXPECT_EQ(read(), some_record(size < kRecordSlotBytes + kSafetyRecordBytes ? 1 : 2)) << size;
  }
}

TEST_F(RecordFileTest, ABitThatFlipsAnywhereCostsOneRecordAtMost) {
  RecordFile file(path_);
  ASSERT_TRUE(file.prepare(kKept));
  ASSERT_TRUE(file.write(some_record(1)));
  ASSERT_TRUE(file.write(some_record(2)));
  const Bytes whole = bytes_of(path_);
  std::size_t lost = 0;
  for (const std::size_t begin : {std::size_t{0}, kRecordSlotBytes, kRecordSlots * kRecordSlotBytes, kRecordFileBytes - 200}) {
    for (std::size_t byte = begin; byte < begin + 200; ++byte) {
      Bytes flipped = whole;
      flipped[byte] ^= 0x10;
      put(path_, flipped);
      const std::optional<SafetyRecord> found = read();
      ASSERT_TRUE(found) << byte;
      lost += *found == some_record(2) ? 0 : 1;
    }
  }
  EXPECT_EQ(lost, kSafetyRecordBytes) << "of the newest's own bytes each counts, and no other";
}

TEST_F(RecordFileTest, GoesOnInTheSlotThatDoesNotHoldTheNewest) {
  {
    RecordFile file(path_);
    ASSERT_TRUE(file.prepare(kKept));
    ASSERT_TRUE(file.write(some_record(1)));
    ASSERT_TRUE(file.write(some_record(2)));
  }
  RecordFile file(path_);
  ASSERT_TRUE(file.open());
  ASSERT_EQ(file.newest(), some_record(2));
  ASSERT_TRUE(file.write(some_record(3)));
  Bytes bytes = bytes_of(path_);
  bytes[20] ^= 1U;  // of the first slot, in which the third stands
  put(path_, bytes);
  EXPECT_EQ(read(), some_record(2));
}

TEST_F(RecordFileTest, IsWrittenThoughTheDiskHasBecomeFull) {
  const std::unique_ptr<support::SmallDisk> disk = support::SmallDisk::make(256 * 1024);
  if (!disk) GTEST_SKIP() << "this kernel lets only root mount a file system";
  RecordFile file(disk->path() / "journal.safety");
  ASSERT_TRUE(file.prepare(kKept));
  const std::string much(1'000'000, 'x');
  std::ofstream(disk->path() / "others") << much;
  RecordFile late(disk->path() / "late.safety");
  EXPECT_FALSE(late.prepare(kKept)) << "the disk is full";
  for (std::uint64_t sequence = 1; sequence <= 4; ++sequence) ASSERT_TRUE(file.write(some_record(sequence)));
  EXPECT_EQ(file.newest(), some_record(4));
}

TEST_F(RecordFileTest, IsWrittenOnceADiskThatWasReadOnlyWhenItWasOpenedIsNoLonger) {
  const std::unique_ptr<support::SmallDisk> disk = support::SmallDisk::make(256 * 1024);
  if (!disk) GTEST_SKIP() << "this kernel lets only root mount a file system";
  const fs::path path = disk->path() / "journal.safety";
  {
    RecordFile file(path);
    ASSERT_TRUE(file.prepare(kKept));
    ASSERT_TRUE(file.write(some_record(1)));
  }
  ASSERT_TRUE(disk->set_read_only(true));
  RecordFile file(path);
  ASSERT_TRUE(file.open());
  ASSERT_TRUE(file.claim());
  EXPECT_FALSE(file.write(some_record(2)));
  EXPECT_FALSE(file.prepare(kKept));
  EXPECT_EQ(file.newest(), some_record(1)) << "it is read meanwhile";
  ASSERT_TRUE(disk->set_read_only(false));
  EXPECT_TRUE(file.write(some_record(2)));
  EXPECT_TRUE(file.prepare(kKept));
  EXPECT_EQ(file.newest(), some_record(2));
  RecordFile other(path);
  ASSERT_TRUE(other.open());
  EXPECT_FALSE(other.claim()) << "it is still this one's";
}

TEST_F(RecordFileTest, IsOneProcessesAloneUntilThatHasEnded) {
  RecordFile file(path_);
  ASSERT_TRUE(file.prepare(kKept));
  {
    RecordFile other(path_);
    ASSERT_TRUE(other.open());
    EXPECT_FALSE(other.claim());
    EXPECT_FALSE(other.prepare(kKept));
    EXPECT_NE(other.holder().find("is writing this file"), std::string::npos) << other.holder();
  }
  file = RecordFile(folder_ / "another");
  RecordFile next(path_);
  ASSERT_TRUE(next.open());
  EXPECT_TRUE(next.claim());
}

TEST_F(RecordFileTest, TakesNoLinkAndNothingThatIsNoRegularFile) {
  put(folder_ / "elsewhere", Bytes(kRecordFileBytes));
  fs::create_symlink(folder_ / "elsewhere", path_);
  RecordFile link(path_);
  EXPECT_FALSE(link.open());
  EXPECT_FALSE(link.prepare(kKept));
  fs::remove(path_);
  fs::create_directory(path_);
  EXPECT_FALSE(RecordFile(path_).open());
}

TEST_F(RecordFileTest, BelievesNoFileThatOthersMayWriteOrOwn) {
  {
    RecordFile file(path_);
    ASSERT_TRUE(file.prepare(kKept));
    ASSERT_TRUE(file.write(some_record(1)));
  }
  fs::permissions(path_, fs::perms::others_write, fs::perm_options::add);
  RecordFile open_to_all(path_);
  EXPECT_FALSE(open_to_all.open());
  EXPECT_TRUE(open_to_all.is_anybodys());
  fs::permissions(path_, fs::perms::others_write, fs::perm_options::remove);
  EXPECT_EQ(read(), some_record(1));
  if (::chown(path_.c_str(), 65534, 65534) != 0) GTEST_SKIP() << "not root";
  RecordFile of_another(path_);
  EXPECT_FALSE(of_another.open());
  EXPECT_TRUE(of_another.prepare(kKept)) << "a flight that begins makes its own";
  EXPECT_TRUE(of_another.write(some_record(2)));
  EXPECT_EQ(read(), some_record(2));
}

TEST_F(RecordFileTest, KnowsAHolderThatOnlyReadsFromOneThatMayFly) {
  RecordFile file(path_);
  ASSERT_TRUE(file.prepare(kKept));
  RecordFile other(path_);
  ASSERT_TRUE(other.open());
  EXPECT_FALSE(other.claim());
  EXPECT_EQ(other.marked_by(), MarkedBy::kThisProgram);
  file.let_go();
  const FileDescriptor reader(::open(path_.c_str(), O_RDONLY | O_CLOEXEC));
  ASSERT_EQ(::flock(reader.number(), LOCK_SH | LOCK_NB), 0);
  EXPECT_FALSE(other.claim());
  EXPECT_EQ(other.marked_by(), MarkedBy::kAnotherProgram);
}

TEST_F(RecordFileTest, KnowsThatItsNameIsGoneOrAnothersOrItsEndIsCut) {
  RecordFile file(path_);
  ASSERT_TRUE(file.prepare(kKept));
  EXPECT_TRUE(file.is_in_place());
  fs::resize_file(path_, 100);
  EXPECT_FALSE(file.is_in_place());
  ASSERT_TRUE(file.prepare(kKept));
  EXPECT_TRUE(file.is_in_place());
  EXPECT_EQ(file.kept(crc32(kKept)), kKept);
  fs::copy_file(path_, folder_ / "restored");
  fs::rename(folder_ / "restored", path_);
  EXPECT_FALSE(file.is_in_place());
  fs::remove(path_);
  EXPECT_FALSE(file.is_in_place());
}

TEST_F(RecordFileTest, LeavesNothingToBeFoundOfAnotherFlightWithHigherNumbers) {
  RecordFile file(path_);
  ASSERT_TRUE(file.prepare(kKept));
  for (const std::uint64_t sequence : {50U, 51U}) {
    SafetyRecord before = some_record(sequence);
    before.journal_crc32 = 1;
    ASSERT_TRUE(file.write(before));
  }
  ASSERT_TRUE(file.write(some_record(5)));
  EXPECT_EQ(read(), some_record(5));
  EXPECT_FALSE(file.is_overtaken());
}

TEST_F(RecordFileTest, WritesNothingOverARecordOfItsFlightThatAnotherProcessWrote) {
  RecordFile hung(path_);
  ASSERT_TRUE(hung.prepare(kKept));
  ASSERT_TRUE(hung.write(some_record(1)));
  SafetyRecord others = some_record(2);
  others.turn = 99;
  RecordFile other(path_);
  ASSERT_TRUE(other.open());
  ASSERT_TRUE(other.write(others));
  EXPECT_FALSE(hung.write(some_record(2)));
  EXPECT_TRUE(hung.is_overtaken());
  EXPECT_EQ(read(), others);
  EXPECT_TRUE(other.write(others)) << "once more what it wrote itself";
  EXPECT_FALSE(other.is_overtaken());
}

}  // namespace
}  // namespace earshot::host
