// What an array hears of a world.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "sim/search/episode/episode.hpp"
#include "sim/search/scenario/surroundings.hpp"
#include "tests/firmware/place.hpp"
#include "tests/sim/search/scenario/scenario_rig.hpp"

namespace earshot::search {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

class Bearings : public testing::Test {
 protected:
  Bearings() { conditions.bearing = BearingConditions{.deviation = Radians{10.0 * kDegree}}; }

  [[nodiscard]] World world() const { return World(settings, soundscape, conditions); }

  /// How far bearings are off the truth, degrees, of many measurements from one place; the source lies at (10 km, 10 km).
  std::vector<double> off_deg(NorthEast place, double truth_deg, int count) {
    const World w = world();
    Surroundings surroundings;
    surroundings.start(w, place, settings.source, Pcg32(5));
    std::vector<double> off;
    for (int i = 0; i < count; ++i) {
      const policy::Reception reception = surroundings.listen(w, place);
      EXPECT_TRUE(reception.bearing && messages::is_possible(*reception.bearing));
      off.push_back(std::remainder(reception.bearing->direction.value / kDegree - truth_deg, 360.0));
    }
    return off;
  }

  Soundscape soundscape{std::vector{one_decibel_per_kilometer()}};
  SearchSettings settings;
  search::Conditions conditions;
};

TEST_F(Bearings, AreNotMeasuredWithoutAnArray) {
  conditions.bearing.reset();
  conditions.fluctuation = Decibels{1.0};
  const World w = world();
  Surroundings surroundings;
  surroundings.start(w, at(20'000, 10'000), settings.source, Pcg32(1));
  EXPECT_FALSE(surroundings.listen(w, at(20'000, 10'000)).bearing);
}

TEST_F(Bearings, LieNormallyAboutTheDirectionOfTheSourceFromTheVehicle) {
  struct Case {
    NorthEast place;
    double truth_deg;
  };
  constexpr int kMeasurements = 20'000;
  for (const Case& c :
       {Case{at(20'000, 10'000), 180.0}, Case{at(10'000, 20'000), 270.0}, Case{at(4'000, 10'000), 0.0}, Case{at(5'000, 5'000), 45.0}}) {
    double sum = 0.0;
    double squares = 0.0;
    int within = 0;
    for (const double off : off_deg(c.place, c.truth_deg, kMeasurements)) {
      sum += off;
      squares += off * off;
      within += std::abs(off) < 10.0 ? 1 : 0;
    }
    // Five standard errors: 5 * 10 / sqrt(20000) of the mean, and that over sqrt(2) of the deviation.
    EXPECT_NEAR(sum / kMeasurements, 0.0, 0.36) << c.truth_deg;
    EXPECT_NEAR(std::sqrt(squares / kMeasurements), 10.0, 0.25) << c.truth_deg;
    EXPECT_NEAR(static_cast<double>(within) / kMeasurements, 0.6827, 0.017) << c.truth_deg;
  }
}

TEST_F(Bearings, SayHowUncertainTheyAreAndNoMirrorImageOfAnArrayThatTellsLeftFromRight) {
  const World w = world();
  Surroundings surroundings;
  surroundings.start(w, at(20'000, 10'000), settings.source, Pcg32(1));
  const auto bearing = surroundings.listen(w, at(20'000, 10'000)).bearing;
  ASSERT_TRUE(bearing);
  EXPECT_DOUBLE_EQ(bearing->deviation.value, 10.0 * kDegree);
  EXPECT_FALSE(bearing->mirror_axis);
}

TEST_F(Bearings, AreNoneOfAMeasurementThatIsTooFaintToMeasure) {
  conditions.floor = Decibels{20.0};
  conditions.fluctuation = Decibels{3.0};
  const World w = world();
  Surroundings surroundings;
  surroundings.start(w, at(20'000, 10'000), settings.source, Pcg32(1));  // 20 dB
  int faint = 0;
  for (int i = 0; i < 200; ++i) {
    const policy::Reception reception = surroundings.listen(w, at(20'000, 10'000));
    EXPECT_EQ(reception.bearing.has_value(), !reception.too_faint);
    faint += reception.too_faint ? 1 : 0;
  }
  EXPECT_GT(faint, 50);
  EXPECT_LT(faint, 150);
}

TEST_F(Bearings, OfAnArrayThatConfusesLeftAndRightLieToStarboardWithTheCourseAsTheMirrorsAxis) {
  conditions.bearing->is_ambiguous = true;
  conditions.bearing->deviation = Radians{1.0 * kDegree};
  const World w = world();
  struct Case {
    NorthEast move;
    double axis_deg;
    double starboard_deg;  ///< of the two directions
    double port_deg;
  };
  // The source lies south, at 180 degrees.
  for (const Case& c :
       {Case{at(0, 100), 90.0, 180.0, 0.0}, Case{at(0, -100), 270.0, 0.0, 180.0}, Case{at(-100, -100), 225.0, 270.0, 180.0}}) {
    Surroundings surroundings;
    const NorthEast place = at(20'000, 10'000);
    surroundings.start(w, place, settings.source, Pcg32(3));
    (void)surroundings.pass(w, c.move, 50.0);
    const auto bearing = surroundings.listen(w, place).bearing;
    ASSERT_TRUE(bearing && bearing->mirror_axis);
    EXPECT_NEAR(bearing->mirror_axis->value / kDegree, c.axis_deg, 1e-9);
    const double direction_deg = bearing->direction.value / kDegree;
    EXPECT_NEAR(std::remainder(direction_deg - c.starboard_deg, 360.0), 0.0, 5.0);
    EXPECT_NEAR(std::remainder(2.0 * c.axis_deg - direction_deg - c.port_deg, 360.0), 0.0, 5.0);
  }
}

TEST_F(Bearings, AreMirroredAboutNorthBeforeTheFirstMoveAndAboutTheLastCourseWhileTheVehicleStands) {
  conditions.bearing->is_ambiguous = true;
  const World w = world();
  Surroundings surroundings;
  const NorthEast place = at(20'000, 10'000);
  surroundings.start(w, place, settings.source, Pcg32(3));
  EXPECT_EQ(surroundings.listen(w, place).bearing->mirror_axis, Radians{0.0});
  (void)surroundings.pass(w, at(0, 100), 50.0);
  (void)surroundings.pass(w, {}, 50.0);
  EXPECT_NEAR(surroundings.listen(w, place).bearing->mirror_axis->value, 0.5 * std::numbers::pi, 1e-12);
}

TEST_F(Bearings, AreOfTheLoudestSourceThatCalls) {
  conditions.sources = 2;
  conditions.bearing->deviation = Radians{0.1 * kDegree};
  const World w = world();
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    Surroundings surroundings;
    const NorthEast place = at(20'000, 12'000);
    surroundings.start(w, place, settings.source, Pcg32(seed));
    const NorthEast way = surroundings.nearest_source(place) - place;  // the loudest, where nothing fluctuates
    const double truth_deg = std::atan2(way.east.value, way.north.value) / kDegree;
    const auto bearing = surroundings.listen(w, place).bearing;
    ASSERT_TRUE(bearing);
    EXPECT_NEAR(std::remainder(bearing->direction.value / kDegree - truth_deg, 360.0), 0.0, 0.6) << seed;
  }
}

TEST_F(Bearings, AreTheSameWhetherListenedToOrPutTogetherFromArrivals) {
  conditions.sources = 3;
  conditions.fluctuation = Decibels{4.0};
  conditions.floor = Decibels{10.0};
  const World w = world();
  Surroundings by_one;
  by_one.start(w, at(22'000, 10'000), settings.source, Pcg32(4));
  Surroundings by_all = by_one;
  for (int measurement = 0; measurement < 50; ++measurement)
    EXPECT_EQ(by_all.reception_of(w, by_all.arrivals(w, at(22'000, 10'000))), by_one.listen(w, at(22'000, 10'000)));
}

TEST_F(Bearings, OfAWindowAreOfItsLastMeasurementThatWasMeasured) {
  settings.listening = {.listening = config::Listening::kLoudest, .length = Duration::seconds(60)};
  conditions.floor = Decibels{-50.0};
  conditions.calls = CallPattern{.interval_s = 25.0, .song_s = 1e6, .pause_s = 0.0, .listening_s = 1.0};
  const World w = world();
  const policy::ObservationModel sees_nothing;
  Episode episode;
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    episode.start_at(w, sees_nothing, kNoOceans, at(20'000, 10'000), settings.source, Pcg32(seed));
    (void)episode.step(w, 0);
    EXPECT_FALSE(episode.reception().too_faint);
    EXPECT_TRUE(episode.reception().bearing) << "a call of 25 s is in every window of 60 s, if seldom its last look";
  }
}

TEST_F(Bearings, LeaveStartSourceAndSnrOfASearchAsTheyAre) {
  conditions.fluctuation = Decibels{4.0};
  const World with = world();
  conditions.bearing.reset();
  const World without = world();
  const policy::ObservationModel sees_nothing;
  Episode one;
  Episode other;
  Pcg32 random(3);
  Pcg32 same(3);
  one.start(with, sees_nothing, kNoOceans, random);
  other.start(without, sees_nothing, kNoOceans, same);
  EXPECT_EQ(one.position(), other.position());
  EXPECT_EQ(one.source(), other.source());
  EXPECT_EQ(one.snr(), other.snr()) << "of the first look: later ones come from further down the stream";
}

}  // namespace
}  // namespace earshot::search
