// GIVEN a journal that grows, ends, moves or is none, WHEN its flight is followed, THEN it is the right flight, and all of it.

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <thread>

#include "firmware/host/file/bad_input.hpp"
#include "policy/watch/followed_flight.hpp"
#include "policy/watch/publisher.hpp"
#include "tests/firmware/host/journal/known_journal.hpp"
#include "tests/support/temporary_folder.hpp"

namespace earshot::watch {
namespace {

using namespace std::chrono_literals;
namespace fs = std::filesystem;
using journal::WrittenJournal;
using messages::MissionState;

class WatchedJournal : public ::testing::Test {
 protected:
  /// What it takes until there is something, but not for ever.
  static Change next_change(FollowedFlight& flight) {
    Change change = flight.take();
    for (int i = 0; i < 500 && change == Change::kNone; ++i, change = flight.take()) flight.wait(20ms);
    return change;
  }
  static nlohmann::ordered_json whole(FollowedFlight& flight) { return flight.flight().whole(); }
  [[nodiscard]] fs::path unfinished() const {
    fs::create_directories(folder_ / "unfinished-flight");
    return folder_ / "unfinished-flight/journal.lcmlog";
  }
  static void begin(WrittenJournal& journal, Time time) {
    journal.message(time, wire::kMissionChannel, journal::known_mission());
    journal.flush();
  }

  const support::TemporaryFolder folder_;
  const fs::path path_ = folder_ / "journal.lcmlog";
};

TEST_F(WatchedJournal, GrowsAsItIsWritten) {
  WrittenJournal journal(path_);
  begin(journal, journal::kBegan);
  FollowedFlight flight(path_, std::nullopt);
  EXPECT_EQ(next_change(flight), Change::kMore);
  EXPECT_EQ(flight.take(), Change::kNone);
  journal.health(journal::after(1000), 1, MissionState::kSearch);
  journal.flush();
  EXPECT_EQ(next_change(flight), Change::kMore);
  EXPECT_EQ(whole(flight)["strips"]["time_s"], nlohmann::ordered_json::array({1}));
  EXPECT_EQ(whole(flight)["is_over"], false);
  journal.health(journal::after(2000), 2, MissionState::kDone, messages::EndReason::kCompleted, 1);
  journal.close({.time = journal::after(2000), .ending = messages::Ending::kMissionOver});
  EXPECT_EQ(next_change(flight), Change::kMore);
  EXPECT_EQ(whole(flight)["is_over"], true);
}

TEST_F(WatchedJournal, ThatNobodyWritesAnyMoreIsOverAndLacksItsEnd) {
  {
    WrittenJournal journal(path_);
    begin(journal, journal::kBegan);
    journal.health(journal::after(1000), 1, MissionState::kSearch);
    journal.flush();
    FollowedFlight flight(path_, std::nullopt);
    (void)next_change(flight);
    EXPECT_EQ(whole(flight)["is_over"], false);
    journal.close();  // without a closing record, as if it had been killed
    EXPECT_EQ(next_change(flight), Change::kMore);
    EXPECT_EQ(whole(flight)["is_over"], true);
    EXPECT_FALSE(whole(flight)["shortcomings"].empty());
  }
}

TEST_F(WatchedJournal, OfAFlightUnderWayGoesOnWhileItMovesToItsPlace) {
  journal::write_known_journal(path_);  // of an earlier one, at sea
  auto journal = std::make_unique<WrittenJournal>(unfinished());
  begin(*journal, Time{});
  FollowedFlight flight(folder_.path(), std::nullopt);
  (void)next_change(flight);
  EXPECT_EQ(whole(flight)["began_utc"], nullptr) << "it is of a simulation, and not the older one";
  journal->health(Time{1'000'000}, 1, MissionState::kDone, messages::EndReason::kCompleted, 1);
  journal->close({.time = Time{1'000'000}, .ending = messages::Ending::kMissionOver});
  fs::rename(unfinished(), path_);
  fs::remove(folder_ / "unfinished-flight");
  while (!flight.flight().is_over()) ASSERT_NE(next_change(flight), Change::kNone);
  EXPECT_EQ(whole(flight)["strips"]["time_s"].size(), 1U);
}

TEST_F(WatchedJournal, MakesPlaceForTheMissionThatBeginsInItsFolder) {
  journal::write_known_journal(path_);
  FollowedFlight flight(folder_.path(), std::nullopt);
  while (next_change(flight) != Change::kNone && !whole(flight)["is_over"]) {
  }
  EXPECT_EQ(whole(flight)["began_utc"], "2026-11-22T15:04:00Z");
  WrittenJournal next(folder_ / "journal-2.lcmlog");
  begin(next, journal::after(86'400'000));
  Change change = Change::kMore;
  while (change == Change::kMore) change = next_change(flight);
  EXPECT_EQ(change, Change::kOther);
  (void)next_change(flight);
  EXPECT_EQ(whole(flight)["began_utc"], "2026-11-23T15:04:00Z");
}

TEST_F(WatchedJournal, IsWaitedForAndNotReplacedByAnOlderOne) {
  {
    WrittenJournal old(path_);
    begin(old, Time{});
    old.close({.time = Time{2'000'000}, .ending = messages::Ending::kMissionOver});
  }
  FollowedFlight flight(folder_.path(), 60s);
  EXPECT_EQ(flight.take(), Change::kNone);
  EXPECT_EQ(whole(flight)["mission"], nullptr);
  WrittenJournal journal(unfinished());
  begin(journal, Time{});
  EXPECT_EQ(next_change(flight), Change::kOther);
  EXPECT_EQ(next_change(flight), Change::kMore);
  EXPECT_NE(whole(flight)["mission"], nullptr);
}

TEST_F(WatchedJournal, ThatBeginsAndEndsBetweenTwoSearchesIsShown) {
  const auto fly = [](const fs::path& path) {
    WrittenJournal journal(path);
    begin(journal, Time{});
    journal.close({.time = Time{2'000'000}, .ending = messages::Ending::kMissionOver});
  };
  fly(path_);
  FollowedFlight flight(folder_.path(), 60s);
  EXPECT_EQ(flight.take(), Change::kNone);
  fly(unfinished());
  fs::rename(unfinished(), path_);
  EXPECT_EQ(next_change(flight), Change::kOther);
  EXPECT_EQ(next_change(flight), Change::kMore);
  EXPECT_NE(whole(flight)["mission"], nullptr);
}

TEST_F(WatchedJournal, ThatIsNoneIsRefused) {
  EXPECT_THROW(FollowedFlight(path_, std::nullopt), host::BadInput);
  FollowedFlight none(path_, 0s);
  EXPECT_THROW((void)next_change(none), host::BadInput);
  std::ofstream(path_) << std::string(5000, 'x');
  FollowedFlight other(path_, std::nullopt);
  EXPECT_THROW((void)next_change(other), host::BadInput);
}

TEST_F(WatchedJournal, IsSentWholeOnceAndThenOnlyWhatCame) {
  WrittenJournal journal(path_);
  begin(journal, journal::kBegan);
  journal.health(journal::after(1000), 1, MissionState::kSearch);
  journal.flush();
  FollowedFlight flight(path_, std::nullopt);
  Audience audience;
  Publisher publisher(audience);
  const Change first = next_change(flight);
  publisher.update(flight.flight(), first);
  const auto early = audience.join();
  publisher.update(flight.flight(), Change::kNone);
  const Frame whole = early->next();
  ASSERT_TRUE(whole && whole->starts_with("event: flight\ndata: {") && whole->ends_with("}\n\n"));
  EXPECT_EQ(std::ranges::count(*whole, '\n'), 3);
  publisher.update(flight.flight(), Change::kNone);
  EXPECT_EQ(early->next(), nullptr);

  journal.health(journal::after(2000), 2, MissionState::kSearch);
  journal.flush();
  const auto late = audience.join();
  const Change change = next_change(flight);
  publisher.update(flight.flight(), change);
  const Frame changes = early->next();
  ASSERT_TRUE(changes && changes->starts_with("event: news\ndata: {"));
  const auto value = nlohmann::json::parse(changes->substr(changes->find("data: ") + 6));
  EXPECT_EQ(value["strips"]["time_s"], nlohmann::json::array({2}));
  EXPECT_FALSE(value.contains("mission"));
  const Frame other = late->next();
  ASSERT_TRUE(other && other->starts_with("event: flight\n"));
  EXPECT_EQ(late->next(), nullptr);
}

}  // namespace
}  // namespace earshot::watch
