#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <optional>

#include "firmware/safety/supervisor.hpp"
#include "tests/firmware/safety/rule_rig.hpp"

namespace earshot::safety {
namespace {

/// A vehicle that goes up and down a lane of 2 km at 2 m/s; port 1 brings fixes once a second, and port 2 true ones.
class TwoPorts : public testing::Test {
 protected:
  struct Ended {
    double way_m = 0.0;   ///< of the vehicle
    double away_m = 0.0;  ///< what port 1 says, at the most
    std::optional<config::Condition> by;
  };

  /// @param away_m  eastwards from the vehicle, of what port 1 says then
  template <class Away>
  Ended search(Away away_m, std::int64_t true_period_s, double for_m) {
    supervisor_.configure(mission_);
    situation_.navigation = NavigationJudge(mission_.safety.vehicle, mission_.navigation_timeout);
    situation_.search_began = at_s(0);
    Ended ended;
    for (std::int64_t s = 0; ended.way_m < for_m && !ended.by; ++s) {
      ended.way_m = kSpeed_mps * static_cast<double>(s);
      const NorthEast place = on_lane(ended.way_m);
      const NorthEast said = place + at(0.0, away_m(ended.way_m));
      hear(s, said, 1);
      if (s % true_period_s == 0) hear(s, place, 2);
      ended.away_m = std::max(ended.away_m, range_between(situation_.navigation.newest()->position, place).value);
      situation_.now = situation_.snr = at_s(s);
      static_cast<void>(supervisor_.watch(mission_, situation_));
      if (supervisor_.response() >= config::Response::kAbort) ended.by = supervisor_.cause();
    }
    return ended;
  }

  config::Mission mission_ = with_much_time();

 private:
  static constexpr double kSpeed_mps = 2.0;

  static config::Mission with_much_time() {
    config::Mission mission = fenced_mission();
    mission.max_time = Duration::seconds(1'000'000);
    return mission;
  }
  static Time at_s(std::int64_t s) { return Time{} + Duration::seconds(1000 + s); }
  static NorthEast on_lane(double way_m) {
    constexpr double kLane_m = 2000.0;
    const auto lanes = static_cast<std::int64_t>(way_m / kLane_m);
    const double on_it_m = way_m - kLane_m * static_cast<double>(lanes);
    return at(3000.0 + (lanes % 2 == 0 ? on_it_m : kLane_m - on_it_m), 5000.0);
  }
  /// As runtime::Runtime takes it.
  void hear(std::int64_t s, NorthEast place, std::uint8_t port) {
    NavigationJudge& judge = situation_.navigation;
    const messages::Navigation fix = fix_at(at_s(s), place);
    if (judge.belongs_to_another(port, at_s(s))) return judge.compare(at_s(s), fix);
    if (judge.take(at_s(s), fix, true)) judge.hold(port, at_s(s));
  }

  Situation situation_;
  Supervisor supervisor_;
};

// 0.5 % off: 70 m after 14 km, where the bound of a liar leaves 75 m.
TEST_F(TwoPorts, ThatDriftApartWithTheWayEndNoSearch) {
  for (const std::int64_t true_period_s : {1, 5, 20}) {
    const Ended ended = search([](double way_m) { return 0.005 * way_m; }, true_period_s, 14'000.0);
    EXPECT_EQ(ended.by, std::nullopt) << "after " << ended.way_m << " m, a true fix every " << true_period_s << " s";
    EXPECT_NEAR(ended.away_m, 70.0, 1.0);
  }
}

TEST_F(TwoPorts, ThatDriftFurtherApartThanTheBoundOfALiarLeavesEndIt) {
  const Ended ended = search([](double way_m) { return 0.005 * way_m; }, 1, 20'000.0);
  EXPECT_EQ(ended.by, config::Condition::kNavigationDisputed);
  EXPECT_NEAR(ended.way_m, 15'000.0, 100.0) << "75 m, and ten seconds";
}

TEST_F(TwoPorts, OfWhichOneIsPutRightEveryHourNeverEndIt) {
  const Ended ended = search([](double way_m) { return 0.005 * (way_m - 7200.0 * static_cast<int>(way_m / 7200.0)); }, 5, 100'000.0);
  EXPECT_EQ(ended.by, std::nullopt) << "after " << ended.way_m << " m";
}

TEST_F(TwoPorts, ThatAgreedAShortWhileAgoMayNotDifferMuch) {
  const Ended ended = search([](double way_m) { return way_m < 8000.0 ? 0.0 : std::min(0.1 * (way_m - 8000.0), 35.0); }, 1, 9000.0);
  EXPECT_EQ(ended.by, config::Condition::kNavigationDisputed);
  EXPECT_LT(ended.way_m, 8400.0) << "25 m after 250 m, and ten seconds";
}

// The bound of README.md: 125 m and 20 s of 3.5 and 2 m/s. A liar that holds the port, and drifts away until most is tolerated.
TEST_F(TwoPorts, LeadTheVehicleNoFurtherAwayThanASecondSenderOfOnePort) {
  for (const double speed_mps : {0.5, 1.0, 2.0, 5.4}) {
    const auto liar = [speed_mps](double way_m) {
      const double sly_m = 0.005 * std::min(way_m, 14'900.0);
      return sly_m + std::max(way_m - 14'900.0, 0.0) / 2.0 * speed_mps;
    };
    const Ended ended = search(liar, 1, 30'000.0);
    EXPECT_NE(ended.by, std::nullopt);
    EXPECT_LT(ended.away_m, 235.0) << speed_mps << " m/s";
  }
}

}  // namespace
}  // namespace earshot::safety
