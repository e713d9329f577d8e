#include "firmware/desk/replay_view/thinned_track.hpp"

#include <gtest/gtest.h>

namespace earshot::replay_view {
namespace {

TEST(ThinnedTrack, KeepsBeginningEndAndOrderOfATrackOfAnyLength) {
  ThinnedTrack track;
  EXPECT_TRUE(track.places().empty());
  for (int i = 0; i < 1'000'003; ++i) track.add({Meters{static_cast<double>(i)}, Meters{0}});
  const std::vector<NorthEast> places = track.places();
  EXPECT_LE(places.size(), ThinnedTrack::kMost);
  EXPECT_GE(places.size(), ThinnedTrack::kMost / 4);
  EXPECT_EQ(places.front().north.value, 0.0);
  EXPECT_EQ(places.back().north.value, 1'000'002.0);
  const double stride = places[1].north.value;
  for (std::size_t i = 1; i + 1 < places.size(); ++i) ASSERT_EQ(places[i].north.value, static_cast<double>(i) * stride);
}

}  // namespace
}  // namespace earshot::replay_view
