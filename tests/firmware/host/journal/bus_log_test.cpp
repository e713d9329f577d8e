// Logs that stock LCM writes: liblcm's event log, which is what lcm-logger calls.

#include "firmware/host/journal/bus_log.hpp"

#include <gtest/gtest.h>
#include <lcm/eventlog.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/firmware/host/journal/journal_folder.hpp"

namespace earshot::host {
namespace {

class BusLog : public JournalFolder {
 protected:
  /// Messages of so many bytes. @param mode  "w", or "a" as lcm-logger --append
  void log(const std::vector<std::size_t>& sizes, const char* mode = "w") const {
    lcm_eventlog_t* const file = lcm_eventlog_create(path_.c_str(), mode);
    ASSERT_NE(file, nullptr);
    std::string channel = "OTHERS";
    for (const std::size_t size : sizes) {
      Bytes data(size, 0xED);
      lcm_eventlog_event_t event{.eventnum = 0,
                                 .timestamp = 1'795'359'840'000'000,
                                 .channellen = static_cast<std::int32_t>(channel.size()),
                                 .datalen = static_cast<std::int32_t>(size),
                                 .channel = channel.data(),
                                 .data = data.data()};
      ASSERT_EQ(lcm_eventlog_write_event(file, &event), 0);
    }
    lcm_eventlog_destroy(file);
  }
  [[nodiscard]] std::vector<std::size_t> sizes_read(Accepts accepts) const {
    JournalReader reader(path_, accepts);
    std::vector<std::size_t> sizes;
    for (JournalRecord record; reader.next(record);) sizes.push_back(record.data.size());
    return sizes;
  }
};

TEST_F(BusLog, IsReadByWhoAsksForOneWithMessagesLargerThanAnyOfEarshots) {
  log({3, 5'000'000, 0, 7});
  JournalReader reader(path_, Accepts::kBusLogs);
  EXPECT_TRUE(reader.is_bus_log());
  JournalRecord record;
  for (const std::size_t size : {3U, 5'000'000U, 0U, 7U}) {
    ASSERT_TRUE(reader.next(record));
    EXPECT_EQ(record.data, Bytes(size, 0xED));
    EXPECT_EQ(record.channel, "OTHERS");
    EXPECT_EQ(record.time, Time{1'795'359'840'000'000});
  }
  EXPECT_EQ(record.number, 3U);
  EXPECT_FALSE(reader.next(record));
  EXPECT_EQ(reader.end(), JournalReader::End::kWhole);
}

TEST_F(BusLog, IsNoJournalToWhoDoesNotAskForOne) {
  log({3, 4});
  JournalReader reader(path_);
  EXPECT_FALSE(reader.is_bus_log());
  JournalRecord record;
  EXPECT_FALSE(reader.next(record));
}

TEST_F(BusLog, ThatWasGoneOnWithCountsFromZeroAgain) {
  log({3, 4});
  log({5, 6}, "a");
  EXPECT_EQ(sizes_read(Accepts::kBusLogs), (std::vector<std::size_t>{3, 4, 5, 6}));
}

TEST_F(BusLog, WhoseLoggerWasKilledIsReadToItsLastWholeEvent) {
  log({3, 40});
  std::filesystem::resize_file(path_, std::filesystem::file_size(path_) - 1);
  JournalReader reader(path_, Accepts::kBusLogs);
  JournalRecord record;
  ASSERT_TRUE(reader.next(record));
  EXPECT_FALSE(reader.next(record));
  EXPECT_EQ(reader.end(), JournalReader::End::kCut);
}

TEST_F(BusLog, IsNoneWhereAnyNumberIsAnotherOrSomethingStandsBetweenEvents) {
  log({3, 4});
  const Bytes whole = contents();
  ASSERT_TRUE(largest_event_of_bus_log(path_));
  const std::size_t second = 28 + 6 + 3;
  for (const std::size_t at : {std::size_t{11}, second + 4, second + 11, second}) {
    Bytes other = whole;
    other[at] = 0x7F;
    overwrite(other);
    EXPECT_FALSE(largest_event_of_bus_log(path_)) << at;
    EXPECT_EQ(sizes_read(Accepts::kBusLogs).size(), 0U) << at;
  }
}

TEST_F(BusLog, IsNoJournalOfEarshot) {
  write_three_records();
  EXPECT_FALSE(largest_event_of_bus_log(path_));
  EXPECT_EQ(sizes_read(Accepts::kBusLogs).size(), 3U);
}

}  // namespace
}  // namespace earshot::host
