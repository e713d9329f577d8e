#include "policy/training/curve_files.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "firmware/host/file/bad_input.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot::training {
namespace {

TEST(CurveFiles, LieBesideTheCheckpointUnderItsNameAndWithTheSeed) {
  EXPECT_EQ(curve_beside("runs/a.checkpoint"), "runs/a.csv");
  EXPECT_EQ(updates_of("runs/a.csv"), "runs/a.updates.csv");
  EXPECT_EQ(with_seed("runs/a.checkpoint", 3), "runs/a.seed3.checkpoint");
  EXPECT_EQ(with_seed("a", 18'446'744'073'709'551'615U), "a.seed18446744073709551615");
}

TEST(CurveFiles, AreRecordedSoThatTheyCanBeMovedTogetherWithTheCheckpoint) {
  EXPECT_EQ(place_to_record("/x/a.csv", "/x/a.checkpoint"), "") << "beside it, under its name";
  EXPECT_EQ(place_to_record("/x/b.csv", "/x/a.checkpoint"), "b.csv");
  EXPECT_EQ(place_to_record("/x/curves/../curves/b.csv", "/x/a.checkpoint"), "curves/b.csv");
  EXPECT_EQ(place_to_record("/y/b.csv", "/x/a.checkpoint"), "/y/b.csv") << "not below the checkpoint's folder";
}

class EarlierCurve : public testing::Test {
 protected:
  /// Both files as they were with one episode, the checkpoint of then, and what was written after it.
  EarlierCurve() {
    then_.add(search::EpisodeRecord{.reward = -2.0, .steps = 3, .detections = 1, .end = search::EpisodeEnd::kFound}, 3);
    checkpoint_.episodes = written(then_.episodes_csv());
    checkpoint_.updates = written(then_.updates_csv());
    write(then_.episodes_csv() + "2,9,-4,0\n");
    std::ofstream(folder_ / "a.updates.csv") << then_.updates_csv();
  }
  void write(const std::string& episodes) const { std::ofstream(folder_ / "a.csv") << episodes; }
  [[nodiscard]] std::string refusal() const {
    try {
      (void)earlier_curve(folder_ / "a.csv", checkpoint_);
    } catch (const host::BadInput& bad) {
      return bad.what();
    }
    return "not refused";
  }

  const support::TemporaryFolder folder_;
  LearningCurve then_;
  ppo::Continuation checkpoint_;
};

TEST_F(EarlierCurve, EndsWhereTheCheckpointStands) {
  const LearningCurve curve = earlier_curve(folder_ / "a.csv", checkpoint_);
  EXPECT_EQ(curve.episodes(), 1U);
  EXPECT_EQ(curve.episodes_csv(), "episode,steps,reward,found\n1,3,-2,1\n");
}

TEST_F(EarlierCurve, RefusesAFileThatIsShorterOrBeginsOtherwise) {
  const std::string file = folder_ / "a.csv";
  write("episode,steps,reward,found\n1,3,-2,1");
  EXPECT_TRUE(support::tells(refusal(), {file, "shorter", "checkpoint", "written"}));
  write("episode,steps,reward,found\n1,3,-3,1\n2,9,-4,0\n");
  EXPECT_TRUE(support::tells(refusal(), {file, "not", "learning", "curve", "checkpoint"}));
  std::filesystem::remove(folder_ / "a.csv");
  EXPECT_EQ(refusal(), file + ": no such file");
}

}  // namespace
}  // namespace earshot::training
