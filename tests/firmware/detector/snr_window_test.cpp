#include "firmware/detector/snr_window.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "firmware/core/random.hpp"

namespace earshot::detector {
namespace {

using config::Listening;
using config::ListeningWindow;

constexpr ListeningWindow kNewest{};

constexpr ListeningWindow loudest_of(std::int64_t seconds) {
  return {.listening = Listening::kLoudest, .length = Duration::seconds(seconds)};
}
constexpr ListeningWindow mean_of(std::int64_t seconds) {
  return {.listening = Listening::kMean, .length = Duration::seconds(seconds)};
}

constexpr Time second(double s) {
  return {static_cast<std::int64_t>(s * 1e6)};
}
constexpr messages::SnrMeasurement measured(double time_s, double snr_db) {
  return {.time = second(time_s), .snr = Decibels{snr_db}};
}
constexpr messages::SnrMeasurement too_faint(double time_s, double floor_db) {
  return {.time = second(time_s), .snr = Decibels{floor_db}, .too_faint = true};
}
constexpr WindowReception reception(double snr_db, std::uint32_t measurements, std::uint32_t measured) {
  return {.snr = Decibels{snr_db}, .too_faint = measured == 0, .measurements = measurements, .measured = measured};
}

SnrWindow after(const std::vector<messages::SnrMeasurement>& measurements) {
  SnrWindow snr_window;
  for (const messages::SnrMeasurement& measurement : measurements) snr_window.take(measurement);
  return snr_window;
}

TEST(SnrWindow, TellsTheNewestMeasurementAloneUnlessAskedForAWindow) {
  const SnrWindow snr_window = after({measured(1, 30), measured(2, 12)});
  EXPECT_EQ(snr_window.reception(kNewest, second(2)), reception(12, 1, 1));
  EXPECT_EQ(after({measured(1, 30), too_faint(2, 3)}).reception(kNewest, second(2)), reception(3, 1, 0));
}

TEST(SnrWindow, CountsAsManySecondsAsTheWindowIsLong) {
  std::vector<messages::SnrMeasurement> measurements;
  for (int s = 1; s <= 40; ++s) measurements.push_back(measured(s, 100.0 - s));  // ever softer
  const SnrWindow snr_window = after(measurements);
  EXPECT_EQ(snr_window.reception(loudest_of(1), second(40)), reception(60, 1, 1));
  EXPECT_EQ(snr_window.reception(loudest_of(15), second(40)), reception(74, 15, 15));  // seconds 26 to 40
  EXPECT_EQ(snr_window.reception(mean_of(15), second(40)), reception(67, 15, 15));     // of 60 to 74
  EXPECT_EQ(snr_window.reception(loudest_of(120), second(40)), reception(99, 40, 40));
}

TEST(SnrWindow, HearsAPulseThatComesOnceInItsWindowWhereverItFalls) {
  for (int pulse = 1; pulse <= 15; ++pulse) {
    SnrWindow snr_window;
    for (int s = 1; s <= 15; ++s) snr_window.take(s == pulse ? measured(s, 21) : too_faint(s, 3));
    EXPECT_EQ(snr_window.reception(loudest_of(15), second(15)), reception(21, 15, 1)) << pulse;
    EXPECT_EQ(snr_window.reception(mean_of(15), second(15)), reception(21, 15, 1)) << pulse;
    EXPECT_EQ(snr_window.reception(kNewest, second(15)).too_faint, pulse != 15);
  }
}

TEST(SnrWindow, TellsTheHighestFloorWhenNothingCouldBeMeasured) {
  const SnrWindow snr_window = after({too_faint(1, 5), too_faint(2, 8), too_faint(3, 4)});
  EXPECT_EQ(snr_window.reception(loudest_of(10), second(3)), reception(8, 3, 0));
  EXPECT_EQ(snr_window.reception(mean_of(10), second(3)), reception(8, 3, 0));
  EXPECT_EQ(snr_window.reception(loudest_of(1), second(3)), reception(4, 1, 0));
  EXPECT_EQ(after({too_faint(1.2, -5), too_faint(1.4, -8)}).reception(loudest_of(2), second(1.5)),
            reception(-5, 2, 0));  // within a second, too
}

TEST(SnrWindow, TakesWhatWasMeasuredBeforeAFloorThatIsHigher) {
  const SnrWindow snr_window = after({measured(1, 4), too_faint(2, 12), measured(3, 6)});
  EXPECT_EQ(snr_window.reception(loudest_of(3), second(3)), reception(6, 3, 2));
  EXPECT_EQ(snr_window.reception(mean_of(3), second(3)), reception(6, 1, 1));
}

TEST(SnrWindow, TakesTheNewestMeasurementForAMeanWhoseLowerPartMayLieBelowTheFloor) {
  // The mean of the two that were measured lies 9 dB above the floor of 5, 10 dB above that of 4.
  EXPECT_EQ(after({measured(1, 16), too_faint(2, 5), measured(3, 12)}).reception(mean_of(3), second(3)), reception(12, 1, 1));
  EXPECT_EQ(after({measured(1, 16), too_faint(2, 4), measured(3, 12)}).reception(mean_of(3), second(3)), reception(14, 3, 2));
  // In one second as in several, and though the second's floor comes first; the highest floor counts.
  EXPECT_EQ(after({too_faint(1.1, 5), too_faint(1.2, 2), measured(1.3, 16), measured(1.4, 12)}).reception(mean_of(3), second(1.5)),
            reception(12, 1, 1));
  // The newest was too faint itself.
  EXPECT_EQ(after({measured(1, 8), measured(2, 9), too_faint(3, 5)}).reception(mean_of(3), second(3)), reception(5, 1, 0));
  // What was measured throughout is a mean however faint.
  EXPECT_EQ(after({measured(1, 4), measured(2, 2)}).reception(mean_of(3), second(3)), reception(3, 2, 2));
}

TEST(SnrWindow, HearsLevelsBelowZeroAsTheyAre) {
  const SnrWindow snr_window = after({measured(1, -20), measured(1.5, -30), measured(3, -40)});
  EXPECT_EQ(snr_window.reception(loudest_of(3), second(3)), reception(-20, 3, 3));
  EXPECT_EQ(snr_window.reception(mean_of(3), second(3)), reception(-30, 3, 3));
}

TEST(SnrWindow, TakesTenMeasurementsASecondFromEachOfFourSendersForTwoMinutes) {
  SnrWindow snr_window;
  for (int tenth = 0; tenth < 1'200; ++tenth) {
    for (int sender = 0; sender < 4; ++sender)
      snr_window.take(measured(0.1 * tenth + 0.01 * sender, tenth == 7 && sender == 2 ? 25 : sender));
  }
  EXPECT_EQ(snr_window.reception(loudest_of(120), second(119.99)), reception(25, 4'800, 4'800));
  EXPECT_EQ(snr_window.reception(loudest_of(119), second(119.99)), reception(3, 4'760, 4'760));
}

TEST(SnrWindow, CountsAMeasurementThatComesLateWhereItsDateBelongs) {
  SnrWindow snr_window = after({measured(10, 5), measured(20, 6), measured(12, 30)});
  EXPECT_EQ(snr_window.reception(loudest_of(9), second(20)), reception(30, 2, 2));  // seconds 12 to 20
  EXPECT_EQ(snr_window.reception(loudest_of(8), second(20)), reception(6, 1, 1));
  EXPECT_EQ(snr_window.reception(kNewest, second(20)), reception(6, 1, 1));
}

TEST(SnrWindow, ForgetsWhatIsOlderThanAnyWindow) {
  SnrWindow snr_window = after({measured(200, 5), measured(80, 30)});  // 120 s older
  EXPECT_EQ(snr_window.reception(loudest_of(120), second(200)), reception(5, 1, 1));
  snr_window.take(measured(81, 20));
  EXPECT_EQ(snr_window.reception(loudest_of(120), second(200)), reception(20, 2, 2));
}

TEST(SnrWindow, HearsNothingOfBeforeAGap) {
  for (const double gap_s : {119.0, 120.0, 121.0, 1e6}) {
    const SnrWindow snr_window = after({measured(1, 30), measured(2, 29), measured(2 + gap_s, 7)});
    EXPECT_EQ(snr_window.reception(loudest_of(60), second(2 + gap_s)), reception(7, 1, 1)) << gap_s;
    const WindowReception widest = snr_window.reception(loudest_of(120), second(2 + gap_s));
    EXPECT_EQ(widest, gap_s < 120.0 ? reception(29, 2, 2) : reception(7, 1, 1)) << gap_s;
  }
}

TEST(SnrWindow, HearsTheNewestMeasurementHoweverOld) {
  const SnrWindow snr_window = after({measured(1, 30), measured(2, 12)});
  EXPECT_EQ(snr_window.reception(loudest_of(3), second(4)), reception(12, 1, 1));
  EXPECT_EQ(snr_window.reception(loudest_of(3), second(5)), reception(12, 1, 1));
  EXPECT_EQ(snr_window.reception(loudest_of(120), second(1e9)), reception(12, 1, 1));
}

TEST(SnrWindow, TakesAMeasurementFromAheadOfNowForOneOfNow) {
  const SnrWindow snr_window = after({measured(10, 5), measured(13, 4)});
  EXPECT_EQ(snr_window.reception(loudest_of(3), second(11)), reception(4, 1, 1));
  EXPECT_EQ(snr_window.reception(loudest_of(4), second(11)), reception(5, 2, 2));
}

TEST(SnrWindow, HearsNothingOfAnEarlierLeg) {
  SnrWindow snr_window = after({measured(1, 30), too_faint(2, 28), measured(3, 12)});
  snr_window.begin_leg(second(3));
  EXPECT_EQ(snr_window.reception(loudest_of(60), second(3)), reception(12, 1, 1)) << "until there is another, the newest counts";
  snr_window.take(measured(4, 9));
  EXPECT_EQ(snr_window.reception(loudest_of(60), second(4)), reception(9, 1, 1));
  snr_window.take(too_faint(4.5, 3));
  EXPECT_EQ(snr_window.reception(loudest_of(60), second(5)), reception(9, 2, 1));
}

TEST(SnrWindow, HearsNothingOfAnEarlierLegThatArrivesLate) {
  SnrWindow snr_window = after({measured(98, 30)});
  snr_window.begin_leg(second(100));
  snr_window.take(measured(99.8, 20));
  EXPECT_EQ(snr_window.reception(loudest_of(30), second(100)), reception(20, 1, 1)) << "until there is another, the newest counts";
  snr_window.take(too_faint(100, 3));
  snr_window.take(too_faint(101, 4));
  EXPECT_EQ(snr_window.reception(loudest_of(30), second(101)).measured, 0U);
  EXPECT_EQ(snr_window.reception(loudest_of(30), second(101)).measurements, 2U);
}

TEST(SnrWindow, HearsOnClocksThatBeganBeforeTheirEpoch) {
  const SnrWindow snr_window = after({measured(-2.5, 8), measured(-0.5, 7), measured(0.5, 6)});
  EXPECT_EQ(snr_window.reception(loudest_of(4), second(0.5)), reception(8, 3, 3));
  EXPECT_EQ(snr_window.reception(loudest_of(2), second(0.5)), reception(7, 2, 2));  // the seconds from -1 and from 0
  EXPECT_EQ(snr_window.reception(loudest_of(1), second(0.5)), reception(6, 1, 1));
}

/// What a window with room for every measurement says.
WindowReception by_hand(const std::vector<messages::SnrMeasurement>& measurements, ListeningWindow window, Time now) {
  const std::int64_t last = now.us / 1'000'000;
  std::vector<double> levels;
  std::vector<double> floors;
  for (const messages::SnrMeasurement& measurement : measurements) {
    if (measurement.time.us / 1'000'000 + window.length.us / 1'000'000 > last)
      (measurement.too_faint ? floors : levels).push_back(measurement.snr.value);
  }
  const auto count = static_cast<std::uint32_t>(levels.size() + floors.size());
  if (levels.empty()) return reception(std::ranges::max(floors), count, 0);
  return reception(std::ranges::max(levels), count, static_cast<std::uint32_t>(levels.size()));
}

TEST(SnrWindow, SaysWhatOneSaysThatRemembersEverything) {
  Pcg32 random(3);
  for (int flight = 0; flight < 50; ++flight) {
    SnrWindow snr_window;
    std::vector<messages::SnrMeasurement> measurements;
    double now_s = 1'000.0;
    for (int i = 0; i < 300; ++i) {
      now_s += random.uniform_double() < 0.02 ? 200.0 * random.uniform_double() : random.uniform_double();
      const double late_s = random.uniform_double() < 0.1 ? 5.0 * random.uniform_double() : 0.0;
      const double level = 40.0 * random.uniform_double() - 20.0;
      measurements.push_back(random.uniform_double() < 0.7 ? too_faint(now_s - late_s, level) : measured(now_s - late_s, level));
      snr_window.take(measurements.back());
      const auto window = loudest_of(6 + random.next() % 115);  // no shorter than a measurement is late, so that there is one
      ASSERT_EQ(snr_window.reception(window, second(now_s)), by_hand(measurements, window, second(now_s))) << flight << " " << i;
    }
  }
}

}  // namespace
}  // namespace earshot::detector
