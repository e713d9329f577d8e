#include "firmware/boards/linux/apps/end_report.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <fstream>
#include <string>
#include <vector>

#include "firmware/host/journal/words/sentences.hpp"
#include "firmware/host/program/exit_status.hpp"
#include "firmware/host/program/talk.hpp"
#include "firmware/messages/dictionary/mission_words.hpp"
#include "tests/firmware/boards/linux/set_clock.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot::board {
namespace {

/// A simulator's clock that is gone.
class LostClock final : public Clock {
 public:
  [[nodiscard]] std::string lost() const override { return "the simulator"; }
  [[nodiscard]] std::string remark() const override { return "turns were late"; }
  [[nodiscard]] Time now() override { return {}; }
  [[nodiscard]] Time mission_time_of(Time utc) override { return utc; }
  [[nodiscard]] Time arrival_of(Time utc) override { return utc; }
  [[nodiscard]] Wake wait(const Awaited& /*awaited*/) override { return Wake::kLost; }
  [[nodiscard]] bool answered(const runtime::Outputs& /*outputs*/, std::uint64_t /*sent*/) override { return true; }
};

/// What was said on standard error, and the status.
struct Reported {
  int status = -1;
  std::string said;
};

template <class Report>
Reported reported(Report report, program::Talk talk = program::Talk::kNormal) {
  program::set_talk(talk);
  testing::internal::CaptureStderr();
  Reported result;
  result.status = report();
  result.said = testing::internal::GetCapturedStderr();
  program::set_talk(program::Talk::kNormal);
  return result;
}

class EndReport : public testing::Test {
 protected:
  EndReport() {
    result_.began = Time{1'000'000};
    result_.time = Time{91'500'000};
    result_.last.health.steps_taken = 2;
  }
  [[nodiscard]] Reported of_loop(const Clock& clock, program::Talk talk = program::Talk::kNormal) const {
    return reported([&] { return report(result_, clock, ports_, "out/journal.lcmlog"); }, talk);
  }
  void end_in(LoopEnd end, messages::MissionState state, messages::EndReason reason) {
    result_.end = end;
    result_.last.health.state = state;
    result_.last.health.end_reason = reason;
  }

  LoopResult result_;
  const PortSet ports_;
  const SetClock clock_;
  const support::TemporaryFolder folder_;
  const std::filesystem::path path_ = folder_ / "journal.lcmlog";
};

TEST_F(EndReport, OfAMissionThatIsOverSaysHowItEndedAndWhereItsJournalIs) {
  end_in(LoopEnd::kMissionOver, messages::MissionState::kDone, messages::EndReason::kCompleted);
  EXPECT_EQ(of_loop(clock_).status, program::kDone);
  EXPECT_TRUE(support::lines_tell(of_loop(clock_).said, {{"earshotd", "DONE", messages::to_string(messages::EndReason::kCompleted),
                                                          "after 2 steps", "out/journal.lcmlog"}}));
  EXPECT_EQ(of_loop(clock_, program::Talk::kQuiet).said, "");
  end_in(LoopEnd::kMissionOver, messages::MissionState::kAbort, messages::EndReason::kSafetyRule);
  EXPECT_EQ(of_loop(clock_).status, program::kAborted);
}

TEST_F(EndReport, OfAMissionThatWasStoppedGoesByTheStateInWhichTheSignalFoundIt) {
  end_in(LoopEnd::kStopped, messages::MissionState::kAbort, messages::EndReason::kOperatorAbort);
  result_.found_in = messages::MissionState::kSearch;
  const Reported search = of_loop(clock_);
  EXPECT_EQ(search.status, program::kInterrupted);
  EXPECT_TRUE(support::lines_tell(
      search.said, {{"earshotd", "stopped", "after 90 s", "SEARCH", "ended", "ABORT", "stopped", "after 2 steps", "out/journal.lcmlog"}}));
  result_.found_in = messages::MissionState::kStandby;
  EXPECT_EQ(of_loop(clock_).status, program::kDone);
  result_.found_in = messages::MissionState::kAbort;
  EXPECT_EQ(of_loop(clock_).status, program::kAborted);
}

TEST_F(EndReport, OfAVehicleThatWasBroughtUpNamesNeitherStepsNorAJournal) {
  end_in(LoopEnd::kStopped, messages::MissionState::kAbort, messages::EndReason::kOutage);
  result_.found_in = messages::MissionState::kAbort;
  result_.last.health.steps_taken = 0;
  const Reported said = reported([&] { return report(result_, clock_, ports_, {}); });
  EXPECT_TRUE(support::lines_tell(said.said, {{"earshotd", "stopped", "after 90 s", "ABORT", "ended", "ABORT",
                                               messages::to_string(messages::EndReason::kOutage), "no journal", "kept"}}));
}

TEST_F(EndReport, SaysEvenQuietlyThatTheClockIsLost) {
  end_in(LoopEnd::kClockLost, messages::MissionState::kSearch, messages::EndReason::kNone);
  const Reported lost = of_loop(LostClock{}, program::Talk::kQuiet);
  EXPECT_EQ(lost.status, program::kLost);
  EXPECT_TRUE(support::lines_tell(
      lost.said,
      {{"earshotd", "turns", "late"}, {"earshotd", "lost", "after 90 s", "SEARCH", "after 2 steps", "up", "then", "out/journal.lcmlog"}}));
}

TEST_F(EndReport, OfAWholeJournalSaysAtSeaWhatAPowerCutCouldHaveCost) {
  host::Journal journal(path_);
  const Status closed = journal.close();
  const Reported simulated = reported([&] { return report(journal, closed, path_, false); });
  EXPECT_EQ(simulated.status, program::kDone);
  EXPECT_EQ(simulated.said, "");
  const Reported at_sea = reported([&] { return report(journal, closed, path_, true); });
  EXPECT_TRUE(support::lines_tell(at_sea.said, {{"earshotd", "within 0.000 s", "cut"}}));
}

TEST_F(EndReport, SaysEvenQuietlyThatTheJournalIsNotWhole) {
  host::Journal journal(path_);
  (void)journal.close();
  const Reported torn = reported([&] { return report(journal, Status::kNotReady, path_, true); }, program::Talk::kQuiet);
  EXPECT_EQ(torn.status, program::kLost);
  EXPECT_TRUE(support::lines_tell(
      torn.said, {{"earshotd", "not whole", "0 records lost", journal::to_string(messages::LostRecords{}), "0 writes failed"}}));
}

TEST_F(EndReport, NamesTheLastJournalThatWasDeletedForTheBudget) {
  // Two of 1 MB, and one that may not be beside both.
  for (const char* name : {"journal.lcmlog", "journal-2.lcmlog"})
    std::ofstream(folder_ / name, std::ios::binary) << "\xED\xA1\xDA\x01" << std::string(1'000'000, 'x');
  host::Journal journal(path_, {.existing = host::ExistingJournal::kKeep, .limits = {.part_bytes = 300'000, .budget_bytes = 600'000}});
  ASSERT_EQ(journal.append(Time{}, "CHANNEL", std::vector<std::uint8_t>(100)), Status::kOk);
  const Status closed = journal.close();
  const Reported said = reported([&] { return report(journal, closed, path_, false); });
  EXPECT_EQ(said.status, program::kDone);
  EXPECT_TRUE(support::lines_tell(
      said.said, {{"earshotd", "2 journals", "deleted", "within --journal-budget-mb", "up", (folder_ / "journal-2.lcmlog").string()}}));
}

}  // namespace
}  // namespace earshot::board
