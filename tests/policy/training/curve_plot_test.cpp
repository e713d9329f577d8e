#include "policy/training/curve_plot.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "policy/training/learning_curve.hpp"
#include "tests/support/process.hpp"
#include "tests/support/temporary_folder.hpp"

namespace earshot::training {
namespace {

search::EpisodeRecord episode(double reward) {
  return {.reward = reward, .steps = 3, .detections = 0, .end = search::EpisodeEnd::kTimeLimit};
}

TEST(CurvePlot, SaysWhatWasTrained) {
  LearningCurve curve;
  for (int i = 0; i < 3; ++i) curve.add(episode(-i), 1);
  const support::TemporaryFolder folder;
  draw_curves(folder / "curve.svg", "source fixed, state fixed_simple", std::vector<std::string>{curve.episodes_csv()});
  const std::string svg = support::read_text(folder / "curve.svg");
  EXPECT_NE(svg.find("<title>source fixed, state fixed_simple</title>"), std::string::npos);
  EXPECT_NE(svg.find(">source fixed, state fixed_simple<"), std::string::npos) << "over the curve, no letter of it lowered";
}

TEST(CurvePlot, OfSeveralTrainingsShowsTheQuartilesOfTheirMedians) {
  std::vector<std::string> curves;
  for (int training = 0; training < 5; ++training) {
    LearningCurve curve;
    for (int i = 0; i < 3; ++i) curve.add(episode(-10.0 * training), 1);
    if (training == 0) curve.add(episode(7.0), 1);  // beyond the shortest training: not shown
    curves.push_back(curve.episodes_csv());
  }
  const std::vector<CurvePoint> points = points_of(curves);
  ASSERT_EQ(points.size(), 3U);
  EXPECT_EQ(points.back().episode, 3U);
  EXPECT_EQ(points.back().lower, -30.0);
  EXPECT_EQ(points.back().median, -20.0);
  EXPECT_EQ(points.back().upper, -10.0);
}

}  // namespace
}  // namespace earshot::training
