#include "sim/apps/fly/flight_record.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "tests/support/temporary_folder.hpp"

namespace earshot::fly {
namespace {

TrackPoint point_at(std::int64_t s, messages::MissionState state, std::uint32_t steps_taken) {
  return {.time = Time{s * 1'000'000}, .vehicle = {}, .reception = {}, .range = {}, .state = state, .steps_taken = steps_taken};
}

TEST(Score, CountsNoDetectionThatWasHeardBeforeTheSearchBegan) {
  using messages::MissionState;
  search::SearchSettings settings;
  settings.listening = {.listening = config::Listening::kLoudest, .length = Duration::seconds(60)};
  Score score(settings);
  score.hear({.time = Time{1'000'000}, .snr = Decibels{30.0}, .too_faint = false});
  score.add(point_at(1, MissionState::kStandby, 0));
  score.add(point_at(2, MissionState::kSearch, 0));
  score.hear({.time = Time{3'000'000}, .snr = Decibels{5.0}, .too_faint = false});
  score.add(point_at(3, MissionState::kSearch, 1));
  EXPECT_EQ(score.steps(), 1U);
  EXPECT_EQ(score.detections(), 0U);
  score.hear({.time = Time{4'000'000}, .snr = Decibels{30.0}, .too_faint = false});
  score.add(point_at(4, MissionState::kSearch, 2));
  EXPECT_EQ(score.detections(), 1U);
}

TEST(RemoveResults, LeavesNothingOfAnEarlierFlightThatMayLookLikeTheNewOnes) {
  const support::TemporaryFolder folder;
  for (const char* name : {"summary.json", "track.csv", "hearing.csv", "spectrogram.csv", "report.html", "notes.txt"})
    std::ofstream(folder / name) << "earlier";
  remove_results(folder.path());
  for (const auto& entry : std::filesystem::directory_iterator(folder.path())) EXPECT_EQ(entry.path().filename(), "notes.txt");
  EXPECT_TRUE(std::filesystem::exists(folder / "notes.txt"));
}

}  // namespace
}  // namespace earshot::fly
