#include "firmware/safety/navigation_judge.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>

#include "firmware/core/random.hpp"

namespace earshot::safety {
namespace {

Time at_ms(std::int64_t ms) {
  return Time{} + Duration::milliseconds(ms);
}

messages::Navigation fix(std::int64_t date_ms, double north_m, double east_m = 0.0) {
  return {.time = at_ms(date_ms),
          .position = {.north = Meters{north_m}, .east = Meters{east_m}},
          .depth = Meters{300},
          .heading = Radians{0},
          .speed = MetersPerSecond{2}};
}

/// Of a vehicle that makes 3 m/s through water that moves at 1 m/s: 4 m/s over ground and 25 m of noise.
class Judged : public testing::Test {
 protected:
  [[nodiscard]] static config::VehicleLimits vehicle() {
    config::VehicleLimits limits;
    limits.max_speed = MetersPerSecond{3};
    limits.max_current = MetersPerSecond{1};
    return limits;
  }
  /// It arrives when it is dated.
  bool takes(const messages::Navigation& navigation) { return judge_.take(navigation.time, navigation, true); }
  /// From then on for 4 s, twice a second.
  /// @return whether it was believed in the end
  bool jumps(int from_ms, double north_m) {
    bool is_believed = false;
    for (int ms = from_ms; ms <= from_ms + 4000; ms += 500) is_believed = takes(fix(ms, north_m)) || is_believed;
    return is_believed;
  }

  NavigationJudge judge_{vehicle(), Duration::seconds(5)};
};

TEST_F(Judged, BelievesAFixAsFarAsTheVehicleCanHaveGoneAndNoFurther) {
  EXPECT_TRUE(takes(fix(1000, 0)));
  EXPECT_FALSE(takes(fix(2000, 29.1))) << "4 m and 25 m of noise";
  EXPECT_EQ(judge_.newest()->position.north, Meters{0});
  EXPECT_EQ(judge_.jump(at_ms(2000)), Meters{0}) << "one may be noise";
  EXPECT_FALSE(takes(fix(2000, 629)));
  EXPECT_EQ(judge_.jump(at_ms(2000)), Meters{600});
  EXPECT_TRUE(takes(fix(2000, 29)));
  EXPECT_TRUE(takes(fix(3000, 0))) << "and back";
}

TEST_F(Judged, RefusesAStrayFixAndGoesOnWithTheNext) {
  EXPECT_TRUE(takes(fix(1000, 0)));
  EXPECT_FALSE(takes(fix(2000, 10'000)));
  EXPECT_TRUE(takes(fix(3000, 4)));
  EXPECT_EQ(judge_.newest()->position.north, Meters{4});
  EXPECT_GT(judge_.jump(at_ms(4000)), Meters{9000}) << "2 s ago";
  EXPECT_EQ(judge_.jump(at_ms(4001)), Meters{0});
}

TEST_F(Judged, BelievesADeadReckoningThatIsPutRightOnceItHasGoneOnForThreeSeconds) {
  EXPECT_TRUE(takes(fix(1000, 0)));
  for (int ms = 2000; ms < 5000; ms += 500) EXPECT_FALSE(takes(fix(ms, 400))) << ms;
  EXPECT_TRUE(takes(fix(5000, 400)));
  EXPECT_EQ(judge_.newest()->position.north, Meters{400});
  EXPECT_TRUE(judge_.newest_is_correction());
  EXPECT_TRUE(takes(fix(5500, 401)));
  EXPECT_FALSE(judge_.newest_is_correction()) << "it goes on from there";
}

TEST_F(Judged, NeverBelievesAJumpThatNoDeadReckoningMakes) {
  EXPECT_TRUE(takes(fix(1000, 0)));
  for (int ms = 2000; ms < 60'000; ms += 500) EXPECT_FALSE(takes(fix(ms, 2000))) << ms;
}

TEST_F(Judged, BelievesNoFixesThatAreStrayOneByOne) {
  EXPECT_TRUE(takes(fix(1000, 0)));
  for (int ms = 2000; ms < 10'000; ms += 500) EXPECT_FALSE(takes(fix(ms, ms % 1000 == 0 ? 400 : -400))) << ms;
}

// A second sender, 300 m away, as steady as the first.
TEST_F(Judged, StaysWithTheFirstOfTwoSenders) {
  for (int ms = 1000; ms < 30'000; ms += 1000) {
    EXPECT_TRUE(takes(fix(ms, 0.002 * ms)));
    EXPECT_FALSE(takes(fix(ms + 500, 300 + 0.002 * ms)));
    if (ms > 10'000) {
      EXPECT_GT(judge_.jump(at_ms(ms + 500)), Meters{250}) << "half of the fixes: no noise";
    }
  }
}

// An acoustic fix every so often, 4 km off: from the third on it is one sender.
TEST_F(Judged, RemembersASlowSenderForTwiceTheTimeBetweenItsFixes) {
  for (const int period_s : {3, 5, 10, 30}) {
    judge_ = NavigationJudge(vehicle(), Duration::seconds(5));
    const int last_s = 3 * period_s;
    for (int s = 1; s <= last_s; ++s) {
      EXPECT_TRUE(takes(fix(1000 * s, 2.0 * s)));
      const bool comes = s % period_s == 0;
      EXPECT_FALSE(comes && takes(fix(1000 * s, 4000 + 2.0 * s)));
      const bool is_silent = s < last_s && s % period_s > 2;
      EXPECT_EQ(judge_.jump(at_ms(1000 * s)) > Meters{0}, s >= period_s && !is_silent) << s << " of " << period_s;
    }
    EXPECT_GT(judge_.jump(at_ms(1000 * (last_s + 2 * period_s))), Meters{3900}) << period_s;
    EXPECT_EQ(judge_.jump(at_ms(1000 * (last_s + 2 * period_s) + 1)), Meters{0}) << period_s;
  }
}

// Two at one place, one elsewhere, one at the first place again; then three at one place, but 31 s apart.
TEST_F(Judged, TakesStrayFixesForNoSlowSender) {
  int ms = 1000;
  EXPECT_TRUE(takes(fix(ms, 0)));
  const auto is_remembered = [&](int apart_ms, double north_m) {
    ms += apart_ms;
    EXPECT_TRUE(takes(fix(ms, 0)));
    EXPECT_FALSE(takes(fix(ms, north_m)));
    return judge_.jump(at_ms(ms + 2001)) > Meters{0};
  };
  for (const double north_m : {4000.0, 4000.0, 9000.0, 4000.0}) EXPECT_FALSE(is_remembered(5000, north_m));
  for (int i = 0; i < 3; ++i) EXPECT_FALSE(is_remembered(30'001, 6000.0));
  EXPECT_FALSE(is_remembered(30'000, 6000.0)) << "the second";
  EXPECT_TRUE(is_remembered(30'000, 6000.0)) << "the third";
}

// Ten fixes a second, each up to 15 m north or south and east or west.
TEST_F(Judged, CallsNoiseNoJumpThatLasts) {
  Pcg32 random(3);
  int refused = 0;
  int lasts = 0;
  int longest = 0;
  for (int i = 0; i < 36'000; ++i) {
    const double north_m = 0.2 * i + 30.0 * random.uniform_double() - 15.0;
    if (!takes(fix(1000 + 100 * i, north_m, 30.0 * random.uniform_double() - 15.0))) ++refused;
    lasts = judge_.jump(at_ms(1000 + 100 * i)) > Meters{0} ? lasts + 1 : 0;
    longest = std::max(longest, lasts);
  }
  EXPECT_LT(longest, 20) << "two seconds; the rule waits for ten";
  EXPECT_GT(refused, 500) << "there is noise";
}

// 20 m further off every second than the vehicle can have gone.
TEST_F(Judged, RefusesAPlaceThatCreepsAwayFromWhereTheVehicleCanBe) {
  EXPECT_TRUE(takes(fix(1000, 0)));
  int believed = 0;
  while (believed < 100 && takes(fix(2000 + 1000 * believed, 24.0 * (believed + 1)))) ++believed;
  EXPECT_EQ(believed, 2) << "50 m more than 4 m/s make";
}

// 12 m, and the noise of both: 62 m from where it was three seconds ago.
TEST_F(Judged, LetsTheAnchorBeAsFarOffAsNoiseMayAndNoFurther) {
  for (const auto& [ms, north_m] : {std::pair{1000, 0.0}, {2000, 28.0}, {3000, 56.0}}) EXPECT_TRUE(takes(fix(ms, north_m)));
  EXPECT_FALSE(takes(fix(4000, 62.3)));
  EXPECT_TRUE(takes(fix(4000, 61.9)));
}

TEST_F(Judged, BelievesACorrectionByHalfAMetreToo) {
  EXPECT_TRUE(takes(fix(1000, 0)));
  for (int ms = 2000; ms <= 5000; ms += 500) EXPECT_EQ(takes(fix(ms, 25.5 + 0.004 * (ms - 1000))), ms == 5000) << ms;
}

// Each 700 s after the last, so that none but the last counts.
TEST_F(Judged, HasRoomForTheNewestCorrectionAfterAnyNumberOfThem) {
  double north_m = 0.0;
  int ms = 1000;
  const auto is_corrected_by = [&](double by_m) {
    EXPECT_TRUE(takes(fix(ms, north_m)));
    return jumps(ms + 1000, north_m += by_m);
  };
  for (std::size_t i = 0; i < config::kMaxCorrections; ++i, ms += 700'000) EXPECT_TRUE(is_corrected_by(60)) << i;
  EXPECT_TRUE(is_corrected_by(480));
  EXPECT_FALSE(jumps(ms + 7000, north_m + 480)) << "960 m within 6 s";
}

TEST_F(Judged, HoldsAFixAgainstOneOfAMinuteAgo) {
  for (int s = 1; s <= 200; ++s) EXPECT_TRUE(takes(fix(1000 * s, 4.2 * s))) << "0.2 m/s too fast are 24 m in two minutes: " << s;
  int s = 201;
  while (s < 400 && takes(fix(1000 * s, 840 + 4.9 * (s - 200)))) ++s;
  EXPECT_LT(s, 280) << "0.9 m/s too fast are more than 50 m";
}

TEST_F(Judged, BelievesCorrectionsOfFiveHundredMetresInTenMinutes) {
  EXPECT_TRUE(takes(fix(1000, 0)));
  EXPECT_TRUE(jumps(5000, 300));
  EXPECT_FALSE(jumps(10'000, 600)) << "some 250 m of corrections each";
  EXPECT_TRUE(jumps(15'000, 300));
  EXPECT_TRUE(jumps(20'000, 500)) << "but 170 m more";
  EXPECT_TRUE(takes(fix(609'000, 500)));
  EXPECT_TRUE(jumps(620'000, 900)) << "ten minutes later";
  EXPECT_FALSE(jumps(640'000, 1300)) << "and these count from then on";
}

// 60 m, 460 m ten minutes later, and 510 m 6 s after those.
TEST_F(Judged, CountsTheCorrectionsOfTheLastTenMinutesWheneverTheFirstWas) {
  EXPECT_TRUE(takes(fix(1'000'000, 0)));
  EXPECT_TRUE(jumps(1'001'000, 60));
  EXPECT_TRUE(takes(fix(1'600'000, 60)));
  EXPECT_TRUE(jumps(1'601'000, 520));
  EXPECT_FALSE(jumps(1'607'000, 1030)) << "970 m within 6 s";
  EXPECT_TRUE(takes(fix(2'200'000, 520)));
  EXPECT_TRUE(jumps(2'204'500, 1000)) << "ten minutes after that";
}

TEST_F(Judged, CountsCorrectionsAtTheBeginOfTheClockToo) {
  EXPECT_TRUE(takes(fix(591'000, 0)));
  EXPECT_TRUE(jumps(592'000, 500));
  EXPECT_FALSE(jumps(601'000, 1020));
}

// 45 m every 3.5 s, 13 m/s: some 7 m more than 4 m/s and 25 m of noise each time.
TEST_F(Judged, BelievesNoPlaceThatGoesAwayInManySmallCorrections) {
  for (int i = 0; i < 600; ++i) (void)takes(fix(1000 + 500 * i, 45.0 * (i / 7)));
  // 4 m/s for 300 s, corrections of 500 m, noise of a last one, and of the anchor.
  EXPECT_LT(judge_.newest()->position.north, Meters{1200 + 500 + 25 + 50});
}

TEST_F(Judged, RefusesDatesFarFromTheirArrival) {
  EXPECT_TRUE(judge_.take(at_ms(10'000), fix(10'500, 0), true));
  EXPECT_EQ(judge_.newest()->time, at_ms(10'000)) << "a date ahead counts as the arrival";
  EXPECT_FALSE(judge_.take(at_ms(11'000), fix(11'501, 0), true));
  EXPECT_TRUE(judge_.take(at_ms(15'000), fix(10'000, 0), true)) << "5 s late";
  EXPECT_FALSE(judge_.take(at_ms(15'001), fix(10'000, 0), true));
}

TEST_F(Judged, RefusesWhatIsOlderThanTheNewestAndWhatIsNoPlace) {
  EXPECT_TRUE(takes(fix(3000, 0)));
  EXPECT_FALSE(judge_.take(at_ms(3500), fix(2999, 0), true));
  EXPECT_FALSE(takes(fix(4000, std::numeric_limits<double>::quiet_NaN())));
  EXPECT_EQ(judge_.jump(at_ms(4000)), Meters{0}) << "that was no jump";
}

TEST_F(Judged, CountsHowLongFixesSayOnePlaceWhileTheVehicleShouldMove) {
  EXPECT_TRUE(takes(fix(1000, 0)));
  EXPECT_TRUE(takes(fix(2000, 2)));
  EXPECT_TRUE(takes(fix(10'000, 2)));
  EXPECT_EQ(judge_.frozen(), Duration::seconds(8));
  EXPECT_TRUE(takes(fix(10'000, 2.5)));
  EXPECT_EQ(judge_.frozen(), Duration{});
  EXPECT_TRUE(judge_.take(at_ms(20'000), fix(20'000, 2.5), false));
  EXPECT_EQ(judge_.frozen(), Duration{}) << "it was told to stay";
}

TEST_F(Judged, StartsOverWhenAVehicleThatIsNotToMoveWasCarriedAbout) {
  EXPECT_TRUE(judge_.take(at_ms(1000), fix(1000, 0), false));
  EXPECT_FALSE(judge_.take(at_ms(6000), fix(6000, 10'000), false));
  EXPECT_TRUE(judge_.take(at_ms(6001), fix(6001, 10'000), false));
  EXPECT_FALSE(judge_.take(at_ms(12'000), fix(12'000, 0), true)) << "never in a search";
}

// The reproduction: 12 km off in 800 s, all true fixes refused as older than the last.
TEST_F(Judged, IsToldOfASecondSenderWithFresherDatesByTheFixesOfTheFirst) {
  EXPECT_TRUE(takes(fix(1000, 0)));
  double walked_m = 0.0;
  for (int ms = 2000; ms <= 60'000 && !(judge_.dispute(at_ms(ms)) > Meters{0}); ms += 1000) {
    walked_m += 4.0;
    EXPECT_TRUE(judge_.take(at_ms(ms), fix(ms, walked_m), true));
    EXPECT_FALSE(judge_.take(at_ms(ms), fix(ms - 200, 0), true));
  }
  EXPECT_LT(walked_m, 33.0) << "25 m of noise, a fifth of a second's way and the next fix";
  EXPECT_GT(judge_.dispute(at_ms(60'000)) + Meters{walked_m}, Meters{0});
}

TEST_F(Judged, TakesALateFixOfTheSamePlaceForNoDispute) {
  EXPECT_TRUE(takes(fix(1000, 0)));
  EXPECT_TRUE(takes(fix(5000, 8)));
  for (const double north_m : {-20.0, 0.0, 8.0, 40.0}) EXPECT_FALSE(judge_.take(at_ms(5000), fix(2000, north_m), true));
  EXPECT_EQ(judge_.dispute(at_ms(5000)), Meters{0});
  EXPECT_FALSE(judge_.take(at_ms(5000), fix(2000, 46), true));
  EXPECT_EQ(judge_.dispute(at_ms(5000)), Meters{1}) << "38 m, of which 12 m of way and 25 m of noise are possible";
  EXPECT_EQ(judge_.dispute(at_ms(7001)), Meters{0}) << "one may be wrong";
}

TEST_F(Judged, RemembersADisputeForTwiceTheTimeBetweenItsFixes) {
  for (int s = 1; s <= 41; ++s) {
    EXPECT_TRUE(takes(fix(1000 * s, 2.0 * s)));
    if (s % 20 == 0) {
      EXPECT_FALSE(judge_.take(at_ms(1000 * s), fix(1000 * s - 500, 900), true));
    }
  }
  EXPECT_GT(judge_.dispute(at_ms(80'000)), Meters{700});
  EXPECT_EQ(judge_.dispute(at_ms(80'001)), Meters{0});
}

// The second sender's are few, and 60 m off; between them one that is refused for a metre.
TEST_F(Judged, ForgetsNoFixThatIsFarOffForOneThatIsNear) {
  EXPECT_TRUE(takes(fix(1000, 0)));
  for (int ms = 1100; ms <= 3000; ms += 100) EXPECT_TRUE(takes(fix(ms, 0)));
  EXPECT_FALSE(takes(fix(3000, 85)));
  EXPECT_EQ(judge_.jump(at_ms(3000)), Meters{60}) << "no noise, one as it is";
  EXPECT_FALSE(takes(fix(3000, 26)));
  EXPECT_EQ(judge_.jump(at_ms(5000)), Meters{60});
  EXPECT_EQ(judge_.jump(at_ms(5001)), Meters{0});
  EXPECT_FALSE(takes(fix(5100, 34.4)));
  EXPECT_EQ(judge_.jump(at_ms(5100)), Meters{0}) << "a metre is noise";
}

// They say one place, and one of them 250 m and the other 300.
TEST_F(Judged, IsToldOfTwoDepthsBySendersOfOnePlace) {
  EXPECT_TRUE(takes(fix(1000, 0)));
  const auto with_depth = [](messages::Navigation of, double depth_m) {
    of.depth = Meters{depth_m};
    return of;
  };
  EXPECT_TRUE(takes(with_depth(fix(2000, 0), 328)));
  EXPECT_EQ(judge_.dispute(at_ms(2000)), Meters{0}) << "3 m of way and 25 m of noise";
  EXPECT_TRUE(takes(with_depth(fix(3000, 0), 290)));
  EXPECT_EQ(judge_.dispute(at_ms(3000)), Meters{10});
  EXPECT_EQ(judge_.dispute(at_ms(5000)), Meters{10});
  EXPECT_EQ(judge_.dispute(at_ms(5001)), Meters{0}) << "a sensor may be wrong once";
  EXPECT_TRUE(takes(with_depth(fix(6000, 0), 290)));
  EXPECT_FALSE(judge_.take(at_ms(6500), with_depth(fix(5000, 0), 250), true)) << "late";
  EXPECT_EQ(judge_.dispute(at_ms(6500)), Meters{12});
  judge_.compare(at_ms(9000), with_depth(fix(9000, 0), 350));
  EXPECT_EQ(judge_.dispute(at_ms(9000)), Meters{26}) << "by another port, three seconds later";
  EXPECT_FALSE(takes(with_depth(fix(12'000, 4000), 400)));
  EXPECT_EQ(judge_.dispute(at_ms(12'000)), Meters{67}) << "one that is refused";
}

// A depth that is wrong for a while every twenty seconds is no sender that is remembered for forty.
TEST_F(Judged, RemembersADepthNoLongerForAllThatCameBefore) {
  EXPECT_TRUE(takes(fix(1000, 0)));
  for (int s = 20; s <= 100; s += 20) {
    messages::Navigation deep = fix(1000 * s, 0);
    deep.depth = Meters{500};
    EXPECT_TRUE(takes(deep));
    EXPECT_TRUE(takes(fix(1000 * s + 1000, 0)));
    EXPECT_GT(judge_.dispute(at_ms(1000 * s + 3000)), Meters{0});
    EXPECT_EQ(judge_.dispute(at_ms(1000 * s + 3001)), Meters{0});
  }
}

// Ten a second, each 20 m further off: from a place of a minute ago the vehicle can have come there, from one of some seconds ago not.
TEST_F(Judged, HoldsAFixAgainstOneOfSomeSecondsAgo) {
  for (int s = 1; s <= 120; ++s) EXPECT_TRUE(takes(fix(1000 * s, 0)));
  int believed = 0;
  while (believed < 100 && takes(fix(120'000 + 100 * (believed + 1), 20.0 * (believed + 1)))) ++believed;
  EXPECT_EQ(believed, 3) << "50 m, and 4 m/s for three to six seconds";
}

// Five of six fixes are another's, which walks away: too few are refused to be more than noise, but they are one sender's.
TEST_F(Judged, IsToldOfAFewFixesThatGoOnFromEachOtherFarFromTheOthers) {
  EXPECT_TRUE(takes(fix(1000, 0)));
  double walked_m = 0.0;
  int ms = 1000;
  while (ms < 200'000 && !(judge_.jump(at_ms(ms)) > Meters{0})) {
    for (int i = 0; i < 5; ++i) (void)takes(fix(ms += 160, walked_m += 0.64));
    (void)takes(fix(ms += 200, 0));
  }
  EXPECT_LT(walked_m, 110.0);
}

TEST_F(Judged, HoldsThePortOfTheFirstFixWhileItSpeaks) {
  EXPECT_FALSE(judge_.belongs_to_another(2, at_ms(1000))) << "nobody has spoken";
  EXPECT_TRUE(takes(fix(1000, 0)));
  judge_.hold(1, at_ms(1000));
  EXPECT_FALSE(judge_.belongs_to_another(1, at_ms(1500)));
  EXPECT_TRUE(judge_.belongs_to_another(2, at_ms(4000)));
  EXPECT_FALSE(judge_.belongs_to_another(2, at_ms(4001))) << "3 s of silence";
  judge_.compare(at_ms(2000), fix(2000, 20));
  EXPECT_EQ(judge_.dispute(at_ms(2000)), Meters{0}) << "it says the same";
  judge_.compare(at_ms(2000), fix(2000, 129));
  EXPECT_EQ(judge_.dispute(at_ms(2000)), Meters{100});
  EXPECT_EQ(judge_.newest()->position.north, Meters{0});
}

// A receiver whose last digits shiver.
TEST_F(Judged, CountsPlacesWithinAFootOfEachOtherAsOne) {
  EXPECT_TRUE(takes(fix(1000, 0)));
  for (int s = 2; s <= 9; ++s) EXPECT_TRUE(takes(fix(1000 * s, s % 2 == 0 ? 0.01 : -0.01)));
  EXPECT_EQ(judge_.frozen(), Duration::seconds(8));
  EXPECT_TRUE(takes(fix(10'000, 0.3)));
  EXPECT_EQ(judge_.frozen(), Duration{});
  for (int s = 11; s <= 60; ++s) {
    EXPECT_TRUE(takes(fix(1000 * s, 0.1 * s)));
    EXPECT_EQ(judge_.frozen(), Duration{}) << "10 cm a second are slow, but no standstill";
  }
}

}  // namespace
}  // namespace earshot::safety
