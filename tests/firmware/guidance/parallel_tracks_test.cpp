#include "firmware/guidance/parallel_tracks.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <set>
#include <vector>

#include "tests/firmware/place.hpp"

namespace earshot::guidance {
namespace {

std::vector<NorthEast> corners_of(const ParallelTracks& tracks) {
  std::vector<NorthEast> corners;
  for (std::size_t i = 0; i < tracks.corner_count(); ++i) corners.push_back(tracks.corner(i));
  return corners;
}

TEST(ParallelTracks, CoverAnAreaNoFurtherApartThanTheSpacingFromTheNearestCorner) {
  // 20 km across in tracks at most 6 km apart: four, 5 km apart, the outer ones 2.5 km from the sides; from the south-east corner west.
  const TrackPlan plan{.area = {at(0, 0), at(10'000, 20'000)}, .spacing = Meters{6'000.0}, .outer = OuterTracks::kHalfASpacingIn};
  EXPECT_EQ(corners_of(ParallelTracks(plan, at(1'000, 19'000))),
            (std::vector<NorthEast>{at(0, 17'500), at(10'000, 17'500), at(10'000, 12'500), at(0, 12'500), at(0, 7'500), at(10'000, 7'500),
                                    at(10'000, 2'500), at(0, 2'500)}));
}

TEST(ParallelTracks, RunEastAndWestWhenAskedTo) {
  const TrackPlan plan{.area = {at(0, 0), at(10'000, 20'000)},
                       .spacing = Meters{5'000.0},
                       .outer = OuterTracks::kHalfASpacingIn,
                       .tracks = Tracks::kEastWest};
  EXPECT_EQ(corners_of(ParallelTracks(plan, at(9'000, 19'000))),
            (std::vector<NorthEast>{at(7'500, 20'000), at(7'500, 0), at(2'500, 0), at(2'500, 20'000)}));
}

TEST(ParallelTracks, LieOnTheSidesWhenWhatIsLookedForMayLieBeyond) {
  // 9 km across in tracks at most 4 km apart: 3 km apart, four of them.
  const TrackPlan plan{.area = {at(1'000, 1'000), at(6'000, 10'000)}, .spacing = Meters{4'000.0}};
  EXPECT_EQ(corners_of(ParallelTracks(plan, at(5'000, 2'000))),
            (std::vector<NorthEast>{at(6'000, 1'000), at(1'000, 1'000), at(1'000, 4'000), at(6'000, 4'000), at(6'000, 7'000),
                                    at(1'000, 7'000), at(1'000, 10'000), at(6'000, 10'000)}));
}

TEST(ParallelTracks, OfThreePassesComeBackToEveryTrackThatTheFirstLeftOut) {
  const TrackPlan plan{.area = {at(0, 0), at(1'000, 12'000)}, .spacing = Meters{2'000.0}, .passes = 3};
  std::vector<double> east_km;
  const ParallelTracks tracks(plan, at(0, 0));
  for (std::size_t i = 0; i < tracks.corner_count(); i += 2) {
    EXPECT_EQ(tracks.corner(i).east, tracks.corner(i + 1).east);
    EXPECT_EQ(tracks.corner(i).north, i % 4 == 0 ? Meters{0.0} : Meters{1'000.0}) << "there, then back";
    east_km.push_back(tracks.corner(i).east.value / 1'000.0);
  }
  EXPECT_EQ(east_km, (std::vector<double>{0, 6, 12, 8, 2, 4, 10}));
}

TEST(ParallelTracks, OfAnyNumberOfPassesTakeEveryTrackOnce) {
  for (std::uint16_t passes = 1; passes <= 9; ++passes) {
    for (int gaps = 1; gaps <= 9; ++gaps) {
      const TrackPlan plan{.area = {at(0, 0), at(1'000, 1'000.0 * gaps)}, .spacing = Meters{1'000.0}, .passes = passes};
      const ParallelTracks tracks(plan, at(0, 1'000.0 * gaps));
      std::set<double> taken;
      for (std::size_t i = 0; i < tracks.corner_count(); i += 2) taken.insert(tracks.corner(i).east.value);
      EXPECT_EQ(tracks.corner_count(), 2U * static_cast<std::size_t>(gaps + 1));
      EXPECT_EQ(taken.size(), static_cast<std::size_t>(gaps + 1)) << passes << " passes over " << gaps << " gaps";
    }
  }
}

TEST(ParallelTracks, OfAnAreaWithoutBreadthAreTwoAndOfOneTooBroadAreAsManyAsAreFlown) {
  const TrackPlan line{.area = {at(0, 500), at(1'000, 500)}, .spacing = Meters{100.0}};
  EXPECT_EQ(corners_of(ParallelTracks(line, at(0, 0))), (std::vector<NorthEast>{at(0, 500), at(1'000, 500), at(1'000, 500), at(0, 500)}));
  for (const double spacing_m : {1e-9, 0.0, std::numeric_limits<double>::denorm_min()}) {
    const TrackPlan broad{.area = {at(0, 0), at(1'000, 1e7)}, .spacing = Meters{spacing_m}, .outer = OuterTracks::kHalfASpacingIn};
    EXPECT_EQ(ParallelTracks(broad, at(0, 0)).corner_count(), 2U * ParallelTracks::kMostTracks);
  }
}

}  // namespace
}  // namespace earshot::guidance
