#include "firmware/host/safety_record/words/record_words.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <vector>

#include "firmware/host/journal/journal.hpp"
#include "firmware/host/safety_record/safety_copies.hpp"
#include "tests/firmware/host/safety_record/some_record.hpp"
#include "tests/support/temporary_folder.hpp"

namespace earshot::host {
namespace {

using namespace std::chrono_literals;

SafetyRecord searching() {
  SafetyRecord record;
  record.utc = {1'795'000'000'000'018};  // 2026-11-18 11:06:40, as date(1) says
  record.state = messages::MissionState::kSearch;
  record.is_engaged = true;
  record.max_depth = Meters{350};
  return record;
}

TEST(RecordWords, SayHowTheVehicleStandsAndWhatTheNextStartMakesOfIt) {
  SafetyRecord record = searching();
  EXPECT_EQ(to_string(record),
            "safety record, 2026-11-18 11:06:40 UTC: SEARCH, set-points leave; depth at most 350 m. earshotd --resume goes on, or brings "
            "the vehicle up");
  record.is_paused = true;
  record.starts = 3;
  EXPECT_EQ(to_string(record),
            "safety record, 2026-11-18 11:06:40 UTC: SEARCH, paused, set-points leave; depth at most 350 m; 3 starts. earshotd --resume "
            "goes on, or brings the vehicle up");
  EXPECT_EQ(to_string(some_record(1)),
            "safety record, 2026-11-18 11:06:40 UTC: ABORT, a safety rule ended it, set-points leave, the drop weight was asked to be "
            "released; depth at most 24 m; 22 starts. The vehicle was not known to be up: earshotd --resume brings it up");
}

TEST(RecordWords, DoNotCallTheAbortOfAProgramThatWasStoppedAnOperators) {
  SafetyRecord record = searching();
  record.state = messages::MissionState::kAbort;
  record.end_reason = messages::EndReason::kOperatorAbort;
  EXPECT_EQ(
      to_string(record),
      "safety record, 2026-11-18 11:06:40 UTC: ABORT, an operator aborted it, or the program as it was stopped, set-points leave; depth "
      "at most 350 m. The vehicle was not known to be up: earshotd --resume brings it up");
}

TEST(RecordWords, SayThatNothingIsUnderWay) {
  SafetyRecord record = searching();
  record.is_closed = true;
  EXPECT_TRUE(to_string(record).ends_with(" m. It was stopped in order, and nothing is under way")) << to_string(record);
  record = searching();
  record.state = messages::MissionState::kStandby;
  record.is_engaged = false;
  EXPECT_TRUE(to_string(record).ends_with(": STANDBY, no set-points leave; depth at most 350 m. Nothing is under way"))
      << to_string(record);
}

class RecordBeside : public testing::Test {
 protected:
  /// @return its mark
  std::uint32_t fly(const char* name) const {
    const std::vector<std::uint8_t> data{1, 2, 3};
    Journal journal(folder_ / name);
    EXPECT_EQ(journal.append(Time{}, name, data), Status::kOk);
    (void)journal.close();
    return checksum_of_record(0, Time{}, name, data);
  }
  void record(std::uint32_t journal_crc32) const {
    SafetyCopies copies({{.file = folder_ / "journal.safety"}});
    copies.prepare(std::vector<std::uint8_t>{1});
    SafetyRecord record = searching();
    record.journal_crc32 = journal_crc32;
    EXPECT_TRUE(copies.write(record, 10s));
  }

  const support::TemporaryFolder folder_;
};

TEST_F(RecordBeside, IsToldOfTheJournalThatItNamesAndOfOneThatIsGone) {
  EXPECT_FALSE(safety_record_beside(folder_ / "journal.lcmlog"));
  record(fly("journal.lcmlog"));
  (void)fly("journal-2.lcmlog");
  EXPECT_TRUE(safety_record_beside(folder_ / "journal.lcmlog"));
  EXPECT_FALSE(safety_record_beside(folder_ / "journal-2.lcmlog")) << "another flight's";
  std::filesystem::remove(folder_ / "journal.lcmlog");
  EXPECT_TRUE(safety_record_beside(folder_ / "journal.lcmlog"));
}

}  // namespace
}  // namespace earshot::host
