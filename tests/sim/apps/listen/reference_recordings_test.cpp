// Recordings of whales that are not part of the project: read where they are, skipped where they are not.
#include <algorithm>

#include "tests/sim/apps/listen/listen_program.hpp"
#include "tests/support/reference_folder.hpp"

namespace earshot::tests {
namespace {

class ReferenceRecording : public ListenProgram {
 protected:
  static std::filesystem::path recordings() { return support::reference_folder() / "recordings"; }

  void SetUp() override {
    if (std::filesystem::is_directory(recordings())) return;
    if (support::is_reference_required()) FAIL() << recordings() << " is not there, and EARSHOT_REFERENCE_REQUIRED=1";
    GTEST_SKIP() << recordings() << " is not there: EARSHOT_REFERENCE_DIR names the folder that holds it";
  }

  /// The begins of what is detected at 6 dB with no other option.
  std::vector<double> detections_in(const std::string& name) {
    EXPECT_EQ(run((recordings() / name).string() + " --threshold 6 --csv " + out("a.csv")), 0) << errors();
    std::vector<double> begins;
    const auto rows = rows_of(content_of(out("a.csv")), ',');
    for (std::size_t i = 1; i < rows.size(); ++i) begins.push_back(std::stod(rows[i][0]));
    return begins;
  }
};

TEST_F(ReferenceRecording, OfAFinWhalesSongIsHeardForNineTenthsWithAtMostFiveOthers) {
  std::vector<double> heard = detections_in("fin_whale_song_450s.wav");
  const auto events = rows_of(content_of(recordings() / "fin_whale_song_450s.events.csv"), ',');
  std::size_t found = 0;
  for (std::size_t i = 1; i < events.size(); ++i) {
    const double time_s = std::stod(events[i][0]);
    const auto match = std::ranges::find_if(heard, [time_s](double begin_s) { return std::abs(begin_s - time_s) <= 2.0; });
    if (match == heard.end()) continue;
    heard.erase(match);
    ++found;
  }
  EXPECT_EQ(events.size() - 1, 47U);
  EXPECT_GE(found, 43U);  // 0.9 * 47
  EXPECT_LE(heard.size(), 5U);
}

TEST_F(ReferenceRecording, OfAWeakBlueWhaleIsHeardInFourToSixCalls) {
  const std::vector<double> heard = detections_in("blue_whale_b_calls_weak_50hz.wav");
  EXPECT_GE(heard.size(), 4U);
  EXPECT_LE(heard.size(), 6U);
}

TEST_F(ReferenceRecording, OfADownSweepIsHeardOnce) {
  EXPECT_EQ(detections_in("fin_low_frequency_downsweep.wav").size(), 1U);
}

}  // namespace
}  // namespace earshot::tests
