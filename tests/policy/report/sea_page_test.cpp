#include "policy/report/sea_page.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/safety_record/safety_copies.hpp"
#include "firmware/messages/dictionary/mission_words.hpp"
#include "policy/report/page.hpp"
#include "tests/policy/report/sea/sea_journal.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot::report {
namespace {

namespace fs = std::filesystem;
using messages::EndReason;
using messages::MissionState;

class SeaPageTest : public testing::Test {
 protected:
  void fly_until(MissionState state, EndReason reason) const {
    SeaJournal journal(folder_ / kJournalName);
    for (int i = 0; i < 10; ++i) journal.fix(i, 3'000 + 100.0 * i, 4'000);
    journal.snr(5, 12.0);
    journal.state(10, MissionState::kSearch, EndReason::kNone, 0);
    journal.decision(90, {});
    if (state != MissionState::kSearch) journal.state(600, state, reason, 3);
    journal.end(messages::Ending::kStopped);
  }
  [[nodiscard]] std::string page_of_it() const {
    const Flight flight = read_flight(folder_);
    return page(flight, pictures_of(flight), {});
  }
  static bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

  support::TemporaryFolder folder_;
};

TEST_F(SeaPageTest, SaysHowAndWhyTheSearchEndedAndWhenTheFlightWas) {
  fly_until(MissionState::kAbort, EndReason::kOperatorAbort);
  const std::string text = page_of_it();
  EXPECT_TRUE(support::has_line(text, {"aborted after 3", "steps", messages::to_string(messages::EndReason::kOperatorAbort)}));
  EXPECT_TRUE(has(text, "<b>2026-11-18 11:06:40 UTC</b>"));
  EXPECT_TRUE(support::has_line(text, {"ABORT", messages::to_string(messages::EndReason::kOperatorAbort), "after 3 steps"}));
  EXPECT_TRUE(has(text, "<td data-name=\"at\">90 s</td>")) << "the decision's time is the flight's";
  EXPECT_EQ(text.find("1970"), std::string::npos);
  EXPECT_TRUE(support::has_line(text, {"earshotd", "stopped", "signal", "ended", "order"}));
  EXPECT_TRUE(has(text, "The journal is whole"));
  EXPECT_FALSE(has(text, "Not there")) << "a simulator's files belong to no flight at sea";
  EXPECT_FALSE(has(text, "A flight without its end"));
}

TEST_F(SeaPageTest, GivesFrequencyDepthAndSpeedOfTheSearchAndWhatADetectionIs) {
  fly_until(MissionState::kDone, EndReason::kStepsUsedUp);
  const std::string text = page_of_it();
  EXPECT_TRUE(has(text, "<dt>frequency searched for</dt><dd>"));
  EXPECT_TRUE(has(text, "<dt>depth of the search</dt><dd>"));
  EXPECT_TRUE(has(text, "<dt>speed of the search</dt><dd>"));
  EXPECT_TRUE(support::has_line(text, {"class=\"meaning\"", "step", "SNR"}));
}

TEST_F(SeaPageTest, DoesNotDenyASourceThatTheVehicleDeclaredFound) {
  fly_until(MissionState::kDone, EndReason::kFound);
  const std::string text = page_of_it();
  EXPECT_TRUE(support::has_line(text, {"ended after 3", "steps", messages::to_string(messages::EndReason::kFound)})) << text;
  EXPECT_FALSE(has(text, "class=\"missed\""));
}

TEST_F(SeaPageTest, SaysInItsHeadWhichRuleEndedTheSearchAndNoneOfThoseThatCameAfter) {
  {
    SeaJournal journal(folder_ / kJournalName);
    journal.state(10, MissionState::kSearch, EndReason::kNone, 0);
    messages::SafetyEvent rule{.time = {},
                               .rule = 9,
                               .condition = config::Condition::kBattery,
                               .response = config::Response::kWarn,
                               .begins = true,
                               .measure = 39.9,
                               .limit = 40.0};
    journal.rule(500, rule);
    rule = {.time = {},
            .rule = 10,
            .condition = config::Condition::kBattery,
            .response = config::Response::kAbort,
            .begins = true,
            .measure = 14.9,
            .limit = 15.0};
    journal.rule(600, rule);
    journal.state(600, MissionState::kAbort, EndReason::kSafetyRule, 3);
    rule.response = config::Response::kRelease;
    rule.rule = 11;
    journal.rule(700, rule);
    journal.end(messages::Ending::kMissionOver);
  }
  EXPECT_TRUE(support::has_line(page_of_it(), {"aborted after 3", "steps", messages::to_string(messages::EndReason::kSafetyRule), "rule 11",
                                               "battery_percent", "14.9", "below 15.0", "abort"}));
}

TEST_F(SeaPageTest, SaysTheMismatchThatTheVehicleSweptAndThatItDeclared) {
  {
    SeaJournal journal(folder_ / kJournalName);
    messages::Decision believing;
    believing.belief.emplace();
    journal.decision(10, believing);
    journal.health(10, 0, 1.0F, false, false);
    journal.health(20, 9, 6.75F, false, false);
    journal.health(30, 11, 12.0F, true, false);
    journal.health(40, 34, 11.5F, true, true);
    journal.end(messages::Ending::kStopped);
  }
  const std::string text = page_of_it();
  EXPECT_TRUE(support::has_line(text, {"step 9", "SNR", "11.5 bits", "6.75", "step 11", "100", "swept", "tracks"}));
  EXPECT_TRUE(support::has_line(text, {"vehicle", "declared", "source", "found", "step 34"}));
}

TEST_F(SeaPageTest, IsOfTheNewestOfSeveralJournalsUnlessAnotherIsNamed) {
  fly_until(MissionState::kDone, EndReason::kCompleted);
  for (const auto& [name, reason] :
       {std::pair{"journal-10.lcmlog", EndReason::kSnrStale}, {"journal-2.lcmlog", EndReason::kOperatorAbort}}) {
    SeaJournal journal(folder_ / name);
    journal.state(10, MissionState::kAbort, reason, 0);
    journal.end(messages::Ending::kStopped);
  }
  EXPECT_EQ(journal_of_flight(folder_.path()), folder_ / "journal-10.lcmlog");
  EXPECT_EQ(read_flight(folder_).sea.value().end_reason, EndReason::kSnrStale);
  const Flight other = read_flight(folder_ / "journal-2.lcmlog");
  EXPECT_EQ(other.sea.value().end_reason, EndReason::kOperatorAbort);
  EXPECT_TRUE(other.is_complete());
}

TEST_F(SeaPageTest, OfASearchThatASignalBrokeOffSaysThatNoOperatorAbortedIt) {
  SeaJournal journal(folder_ / kJournalName);
  journal.state(10, MissionState::kSearch, EndReason::kNone, 0);
  journal.stop(599);
  journal.state(600, MissionState::kAbort, EndReason::kOperatorAbort, 3);
  journal.end(messages::Ending::kStopped);
  const std::string text = page_of_it();
  EXPECT_TRUE(support::has_line(text, {"aborted after 3", "steps", "stopped"}));
  EXPECT_TRUE(support::has_line(text, {"ABORT", "program", "stopped", "after 3 steps"}));
  EXPECT_FALSE(has(text, "an operator aborted it"));
}

TEST_F(SeaPageTest, DrawsTrackAndSnrOfTheJournal) {
  fly_until(MissionState::kDone, EndReason::kCompleted);
  const std::string text = page_of_it();
  EXPECT_TRUE(support::has_line(text, {"ended after 3", "steps", messages::to_string(messages::EndReason::kCompleted)}));
  EXPECT_TRUE(support::has_line(text, {"vehicle's", "track", "navigation"}));
  EXPECT_TRUE(has(text, "<title>SNR against time</title>"));
  EXPECT_TRUE(support::has_line(text, {"Refused", "in", "0", "SNR", "4", "2", "3", "0"}));
}

TEST_F(SeaPageTest, OfAJournalThatEndsInMidSearchSaysThatItsEndIsMissing) {
  fly_until(MissionState::kSearch, EndReason::kNone);
  const fs::path journal = folder_ / kJournalName;
  fs::resize_file(journal, fs::file_size(journal) - (28 + 19 + 47));
  const std::string text = page_of_it();
  EXPECT_TRUE(support::has_line(text, {"journal", "mid-search", "after 0 steps"}));
  EXPECT_TRUE(has(text, "The journal's end is missing"));
}

TEST_F(SeaPageTest, SaysWhatTheSafetyRecordBesideTheJournalSays) {
  fly_until(MissionState::kSearch, EndReason::kNone);
  EXPECT_FALSE(has(page_of_it(), "safety record"));
  host::SafetyCopies copies({{.file = folder_ / "journal.safety"}});
  copies.prepare(std::vector<std::uint8_t>{1});
  host::SafetyRecord record;
  record.utc = {1'795'000'000'000'000};
  record.state = MissionState::kAbort;
  record.end_reason = EndReason::kOutage;
  record.is_engaged = true;
  record.max_depth = Meters{350};
  ASSERT_TRUE(copies.write(record, std::chrono::seconds(10)));
  EXPECT_TRUE(
      support::has_line(page_of_it(), {"safety", "2026-11-18 11:06:40 UTC", "ABORT", messages::to_string(messages::EndReason::kOutage),
                                       "at most 350 m", "not", "up", "--resume", "up"}));
}

}  // namespace
}  // namespace earshot::report
