#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "firmware/core/random.hpp"
#include "firmware/safety/supervisor.hpp"
#include "tests/firmware/safety/rule_rig.hpp"

namespace earshot::safety {
namespace {

/// How a liar brings its fixes.
enum class Way : std::uint8_t {
  kFresher,    ///< of two senders of one port, with dates that are ahead
  kSameDates,  ///< with those of the other
  kOtherPort,
};
constexpr std::size_t kWays = 3;

/// A liar whose place walks away, and who pauses.
struct Liar {
  Way way = Way::kFresher;
  std::int64_t ahead_ms = 400;   ///< of its dates
  std::int64_t period_ms = 100;  ///< of its fixes
  double north_mps = 3.8;        ///< away from the vehicle
  double on_s = 7.0;
  double off_s = 2.9;
  bool goes_back = false;     ///< it begins at the vehicle again after each pause
  std::int64_t stray_ms = 0;  ///< so often it says a place that nobody believes; 0: never
  double stray_m = 200.0;
  bool changes_way = false;  ///< with each pause
};

/// A vehicle that goes eastwards at 2 m/s, its honest sender and its liars; the supervisor looks five times a second.
class SecondSender : public testing::Test {
 protected:
  struct Ended {
    double at_s = 0.0;    ///< the search ended
    double away_m = 0.0;  ///< the place, at most, while it searched
    std::optional<config::Condition> by;
  };

  Ended search(std::initializer_list<Liar> liars, double for_s) {
    Ended ended;
    supervisor_.configure(mission_);
    situation_.navigation = NavigationJudge(mission_.safety.vehicle, mission_.navigation_timeout);
    situation_.search_began = at_ms(kBegin_ms);
    for (std::int64_t ms = kBegin_ms; ms <= kBegin_ms + static_cast<std::int64_t>(1000 * for_s); ms += 10) {
      const std::int64_t since_ms = ms - kBegin_ms - 2000;  // the liars are later
      if (ms % honest_period_ms_ == 0) hear(ms, fix_at(at_ms(ms - honest_delay_ms_), true_place(ms - honest_delay_ms_)), 1);
      std::size_t nth = 0;
      for (const Liar& liar : liars) lie(liar, since_ms - 30 * static_cast<std::int64_t>(++nth), ms);
      if (ms % 200 != 0) continue;
      situation_.now = at_ms(ms);
      situation_.snr = at_ms(ms);
      ended.away_m = std::max(ended.away_m, range_between(situation_.navigation.newest()->position, true_place(ms)).value);
      static_cast<void>(supervisor_.watch(mission_, situation_));
      ended.at_s = 1e-3 * static_cast<double>(ms - kBegin_ms);
      ended.by = supervisor_.cause();
      if (supervisor_.response() >= config::Response::kAbort) break;
    }
    return ended;
  }

  /// Of two liars: fixes, pauses, dates and strays. @param slowest_mps  away from the vehicle
  Liar drawn(Pcg32& random, double slowest_mps) {
    const auto between = [&random](double low, double high) { return low + (high - low) * random.uniform_double(); };
    Liar liar;
    liar.way = static_cast<Way>(random.uniform_double() * kWays);
    liar.ahead_ms = static_cast<std::int64_t>(between(-200.0, 500.0));
    liar.period_ms = 10 * static_cast<std::int64_t>(between(2.0, 60.0));
    liar.north_mps = between(slowest_mps, 60.0) * (random.uniform_double() < 0.5 ? 1.0 : -1.0);
    if (random.uniform_double() < 0.7) liar.north_mps = between(slowest_mps, 4.0);
    liar.on_s = between(0.2, 15.0);
    liar.off_s = between(0.0, 12.0);
    if (random.uniform_double() < 0.5) liar.off_s = between(1.5, 3.0);
    liar.goes_back = random.uniform_double() < 0.5;
    if (random.uniform_double() < 0.5) liar.stray_ms = 10 * static_cast<std::int64_t>(between(5.0, 500.0));
    liar.stray_m = between(30.0, 700.0);
    liar.changes_way = random.uniform_double() < 0.5;
    return liar;
  }

  config::Mission mission_ = fenced_mission();
  std::int64_t honest_period_ms_ = 100;
  std::int64_t honest_delay_ms_ = 0;

 private:
  static constexpr std::int64_t kBegin_ms = 1'000'000;

  static Time at_ms(std::int64_t ms) { return Time{} + Duration::milliseconds(ms); }
  static NorthEast true_place(std::int64_t ms) { return at(5000, 1000 + 0.002 * static_cast<double>(ms - kBegin_ms)); }

  void lie(const Liar& liar, std::int64_t since_ms, std::int64_t ms) {
    if (since_ms < 0 || ms % 10 != 0) return;
    const auto period_ms = static_cast<std::int64_t>(1000 * (liar.on_s + liar.off_s));
    const std::int64_t begun_ms = since_ms % period_ms;
    if (begun_ms >= static_cast<std::int64_t>(1000 * liar.on_s)) return;
    const auto turn = static_cast<std::size_t>(since_ms / period_ms);
    const Way way = liar.changes_way ? static_cast<Way>((static_cast<std::size_t>(liar.way) + turn) % kWays) : liar.way;
    const double away_m = liar.north_mps * 1e-3 * static_cast<double>(liar.goes_back ? begun_ms : since_ms);
    const std::int64_t date_ms = way == Way::kFresher ? ms + liar.ahead_ms : ms - honest_delay_ms_;
    const std::uint8_t port = way == Way::kOtherPort ? 2 : 1;
    if (liar.stray_ms > 0 && since_ms % liar.stray_ms < 10) hear(ms, fix_at(at_ms(date_ms), true_place(ms) + at(0, liar.stray_m)), port);
    if (since_ms % liar.period_ms < 10) hear(ms, fix_at(at_ms(date_ms), true_place(ms) + at(away_m, 0)), port);
  }

  /// As runtime::Runtime takes it.
  void hear(std::int64_t ms, const messages::Navigation& fix, std::uint8_t port) {
    NavigationJudge& judge = situation_.navigation;
    if (judge.belongs_to_another(port, at_ms(ms))) return judge.compare(at_ms(ms), fix);
    if (judge.take(at_ms(ms), fix, true)) judge.hold(port, at_ms(ms));
  }

  Situation situation_;
  Supervisor supervisor_;
};

// The reproduction: 988 m off after 260 s, with timeouts of 15 s and a vehicle of which nobody said how fast it is.
TEST_F(SecondSender, IsFoundThoughItPausesBeforeEachRuleActs) {
  mission_.safety.vehicle = {};
  mission_.navigation_timeout = Duration::seconds(15);
  honest_delay_ms_ = 50;
  const Ended ended = search({{.north_mps = 3.8, .on_s = 7.0, .off_s = 2.9}}, 260.0);
  EXPECT_NE(ended.by, std::nullopt);
  EXPECT_LT(ended.away_m, 125.0);
  EXPECT_LT(ended.at_s, 40.0);
}

TEST_F(SecondSender, IsFoundThoughItPausesAndIsSlow) {
  const Ended ended = search({{.north_mps = 0.9, .on_s = 7.0, .off_s = 2.9}}, 400.0);
  EXPECT_NE(ended.by, std::nullopt);
  EXPECT_LT(ended.away_m, 60.0);
}

// Many for each of the other's, and strays between them, so that no two of those that are refused go on from each other.
TEST_F(SecondSender, IsFoundBehindStrayFixes) {
  honest_period_ms_ = 1000;
  const Ended ended =
      search({{.way = Way::kSameDates, .period_ms = 50, .north_mps = 3.0, .on_s = 1000.0, .off_s = 0.0, .stray_ms = 510, .stray_m = 150.0}},
             400.0);
  EXPECT_NE(ended.by, std::nullopt);
  EXPECT_LT(ended.away_m, 150.0);
}

// Each lies 20 m further than the one before it, fifty times a second; a place of a minute ago is one that a vehicle can have left either
// way.
TEST_F(SecondSender, IsNoFurtherForAllThatItSaysInAMoment) {
  const Ended ended = search({{.period_ms = 20, .north_mps = 1000.0, .on_s = 0.5, .off_s = 120.0, .goes_back = true}}, 130.0);
  EXPECT_GT(ended.away_m, 40.0);
  EXPECT_LT(ended.away_m, 80.0);
}

// Of 3 m/s through the water and 0.5 m/s of current, 2 m/s of its own: 75 m and a second's way that nobody calls a jump, 50 m from a place
// of at most 18 s before, each second 5.5 m.
TEST_F(SecondSender, NeverLeadsThePlaceFurtherAwayThanItsBound) {
  for (const std::int64_t period_ms : {100, 200, 500, 1000}) {
    honest_period_ms_ = period_ms;
    honest_delay_ms_ = period_ms / 5;
    for (std::uint64_t seed = 1; seed <= 200; ++seed) {
      Pcg32 random(seed);
      const Liar first = drawn(random, 0.5);
      const Liar second = drawn(random, 0.5);
      const Ended ended = seed % 2 == 0 ? search({first}, 300.0) : search({first, second}, 300.0);
      EXPECT_LT(ended.away_m, 235.0) << "seed " << seed << " of " << period_ms << " ms, ended at " << ended.at_s;
    }
  }
}

}  // namespace
}  // namespace earshot::safety
