#include "firmware/desk/journal_view/export/record_lines.hpp"

#include <gtest/gtest.h>

#include <array>

#include "tests/firmware/desk/journal_view/export/export_rig.hpp"
#include "tests/firmware/host/journal/known_journal.hpp"
#include "tests/support/temporary_folder.hpp"

namespace earshot::journal {
namespace {

TEST(RecordLines, HoldARecordOnEachLineAndThoseThatCannotBeReadToo) {
  const support::TemporaryFolder folder;
  WrittenJournal journal(folder / "journal");
  journal.input(Time{1'795'359'847'080'925}, 2, messages::SnrMeasurement{.time = Time{1}, .snr = Decibels{12.25}});
  journal.bytes(Time{2'000'000}, "EARSHOT_HEALTH", std::array<std::uint8_t, 1>{7});
  journal.close();
  RecordLines lines(folder / "records.jsonl");
  export_all(folder / "journal", lines);
  EXPECT_EQ(text_of(folder / "records.jsonl"), R"({"number":0,"time_s":1795359847.080925,"channel":"EARSHOT_SNR_ESTIMATE.2","topic":"snr",)"
                                               R"("fields":{"port":2,"valid_time_s":1e-06,"snr_db":12.25,"too_faint":false}})"
                                               "\n"
                                               R"({"number":1,"time_s":2.0,"channel":"EARSHOT_HEALTH","topic":"unknown","fields":null})"
                                               "\n");
  EXPECT_EQ(lines.what(), "2 records");
}

TEST(RecordLines, LeaveNothingBehindThatIsNotFinished) {
  const support::TemporaryFolder folder;
  { const RecordLines lines(folder / "records.jsonl"); }
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

}  // namespace
}  // namespace earshot::journal
