#include "firmware/safety/fence.hpp"

#include <gtest/gtest.h>

#include "tests/firmware/safety/rule_rig.hpp"

namespace earshot::safety {
namespace {

TEST(Fence, TellsHowFarBeyondAPolygonAPlaceLies) {
  const config::Polygon area = square(0, 100);
  EXPECT_EQ(beyond(area, at(50, 50)), Meters{0});
  EXPECT_EQ(beyond(area, at(100, 50)), Meters{0});
  EXPECT_EQ(beyond(area, at(130, 140)), Meters{50});
  EXPECT_EQ(nearest_within(area, at(130, 140)), at(100, 100));
  EXPECT_EQ(nearest_within(area, at(30, 40)), at(30, 40));
}

// Northwards at 2 m/s: 6 m in 3 s, a turning circle of 20 m, and 0.5 m/s for the (pi/2) 20/2 = 15.708 s of a right angle.
TEST(PlaceAfterTurning, IsAsFarAheadAsReactionTurnAndCurrentTake) {
  const config::Mission mission = fenced_mission();
  Situation situation = well(mission, at(1000, 2000));
  EXPECT_NEAR(place_after_turning(mission.safety.vehicle, situation).north.value, 1000 + 6 + 20 + 7.853981633974483, 1e-9);
  EXPECT_NEAR(place_after_turning(mission.safety.vehicle, situation).east.value, 2000, 1e-9);

  // Over ground it goes east, whatever its heading: at 4 m/s, so that a right angle of that way takes half as long.
  situation.track.take(fix_at(situation.now + Duration::seconds(4), at(1000, 2016)));
  EXPECT_NEAR(place_after_turning(mission.safety.vehicle, situation).east.value, 2000 + 12 + 20 + 0.5 * 7.853981633974483, 1e-9);
  EXPECT_NEAR(place_after_turning(mission.safety.vehicle, situation).north.value, 1000, 1e-9);
}

// 33.854 m ahead, 60 degrees from north: half of it north.
TEST(PlaceAfterTurning, LiesWhereTheVehiclePointsWhileNobodyKnowsItsWayOverGround) {
  const config::Mission mission = fenced_mission();
  const NorthEast place = place_after_turning(mission.safety.vehicle, well(mission, at(1000, 2000), 1.0471975511965976));
  EXPECT_NEAR(place.north.value, 1000 + 16.926990816987242, 1e-9);
  EXPECT_NEAR(place.east.value, 2000 + 29.318408114273723, 1e-9);
}

// At 2 m/s through water that comes towards it at 1.875 m/s.
TEST(PlaceAfterTurning, TurnsAgainstACurrentAsFastAsInStillWater) {
  const config::Mission mission = fenced_mission();
  Situation situation = well(mission, at(1000, 2000));
  situation.track.take(fix_at(situation.now + Duration::seconds(4), at(1000.5, 2000)));
  EXPECT_NEAR(place_after_turning(mission.safety.vehicle, situation).north.value, 1000 + 0.375 + 20 + 7.853981633974483, 1e-9);
}

TEST(PlaceAfterTurning, IsWhereTheVehicleStands) {
  const config::Mission mission = fenced_mission();
  Situation situation = well(mission, at(1000, 2000));
  situation.track.take(fix_at(situation.now + Duration::seconds(4), at(1000.3, 2000)));
  EXPECT_EQ(place_after_turning(mission.safety.vehicle, situation), at(1000, 2000));
}

// Nobody knows how fast it goes: as fast as it can.
TEST(PlaceAfterTurning, TakesTheGreatestSpeedForOneThatNobodyKnows) {
  const config::Mission mission = fenced_mission();
  Situation situation = well(mission, at(0, 0));
  messages::Navigation fix = fix_at(situation.now, at(1000, 2000));
  fix.speed = messages::kUnknownSpeed;
  situation.navigation = NavigationJudge(mission.safety.vehicle, mission.navigation_timeout);
  ASSERT_TRUE(situation.navigation.take(situation.now, fix, true));
  EXPECT_NEAR(place_after_turning(mission.safety.vehicle, situation).north.value, 1000 + 9 + 20 + 7.853981633974483 * 2 / 3, 1e-9);
}

}  // namespace
}  // namespace earshot::safety
