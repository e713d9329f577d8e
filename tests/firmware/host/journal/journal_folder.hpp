#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <vector>

#include "firmware/host/journal/journal.hpp"
#include "firmware/host/journal/journal_reader.hpp"
#include "tests/support/temporary_folder.hpp"

namespace earshot::host {

using Bytes = std::vector<std::uint8_t>;

/// A folder of the test's own with a journal in it.
class JournalFolder : public ::testing::Test {
 protected:
  [[nodiscard]] Bytes contents() const {
    std::ifstream file(path_, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  void overwrite(const Bytes& bytes) const {
    std::ofstream file(path_, std::ios::binary | std::ios::trunc);
    file.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  }
  [[nodiscard]] std::size_t records_until(JournalReader::End end) const {
    JournalReader reader(path_);
    JournalRecord record;
    std::size_t count = 0;
    while (reader.next(record)) ++count;
    EXPECT_EQ(reader.end(), end);
    return count;
  }
  void write_three_records() const {
    Journal journal(path_, {.existing = ExistingJournal::kReplace});
    ASSERT_EQ(journal.append(Time{1}, "A", Bytes{1, 2, 3}), Status::kOk);
    ASSERT_EQ(journal.append(Time{2}, "BB", Bytes{}), Status::kOk);
    ASSERT_EQ(journal.append(Time{3}, "CCC", Bytes(40, 0x55)), Status::kOk);
    ASSERT_EQ(journal.close(), Status::kOk);
  }

  const support::TemporaryFolder folder_;
  const std::filesystem::path path_ = folder_ / "journal.lcmlog";
};

}  // namespace earshot::host
