#include "firmware/detector/hydrophone/detection_tracker.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <vector>

namespace earshot::detector {
namespace {

constexpr Duration kQuarter = Duration::milliseconds(250);

/// A tracker that is told P / N quarter by quarter, as a detector with an integration time of 1 s tells it.
class FedTracker {
 public:
  explicit FedTracker(const SoundSettings& settings) : settings_(settings) {
    tracker_.configure(settings);
    tracker_.set_quarter(kQuarter, 30.0);
  }

  void feed(int quarters, double ratio, Hearing hearing = Hearing::kHears) {
    for (int i = 0; i < quarters; ++i) {
      for (std::size_t k = 0; k + 1 < kQuarters; ++k) ratios_[k] = ratios_[k + 1];
      ratios_.back() = ratio;
      now_ = now_ + kQuarter;
      Estimate estimate;
      estimate.time = now_;
      estimate.hearing = hearing;
      double mean = 0.0;
      for (const double r : ratios_) mean += r / 4.0;
      estimate.snr = Decibels{10.0 * std::log10(std::max(mean - 1.0, 1e-3))};
      estimate.level = Decibels{90.0 + 10.0 * std::log10(mean)};
      const bool is_measured = hearing == Hearing::kHears || hearing == Hearing::kClipped;
      estimate.reaches_threshold = is_measured && estimate.snr >= settings_.detection_threshold;
      if (const std::optional<Detection> ended = tracker_.take(estimate, ratios_)) detections.push_back(*ended);
    }
  }
  void finish() {
    if (const std::optional<Detection> last = tracker_.finish()) detections.push_back(*last);
  }

  std::vector<Detection> detections;

 private:
  SoundSettings settings_;
  DetectionTracker tracker_;
  std::array<double, kQuarters> ratios_{1.0, 1.0, 1.0, 1.0};
  Time now_;
};

TEST(DetectionTracker, TellsWhereASoundBeganAndEnded) {
  FedTracker fed(fin_whale());
  fed.feed(40, 1.0);
  fed.feed(6, 101.0);
  fed.feed(40, 1.0);
  ASSERT_EQ(fed.detections.size(), 1U);
  EXPECT_EQ(fed.detections[0].begin, Time{10'000'000});
  EXPECT_EQ(fed.detections[0].duration, Duration::milliseconds(1500));
  EXPECT_NEAR(fed.detections[0].peak_snr.value, 20.0, 1e-9);
  EXPECT_EQ(fed.detections[0].peak, Time{11'000'000}) << "the first estimate that has nothing else";
  EXPECT_EQ(fed.detections[0].estimates, 9U);  // of 1, 2, 3 quarters of the pulse too: 13.98 dB and more; six quarters and three after
}

TEST(DetectionTracker, TakesWhatFluctuatesForOne) {
  FedTracker fed(fin_whale());
  fed.feed(40, 1.0);
  for (int i = 0; i < 8; ++i) {
    fed.feed(4, 20.0);
    fed.feed(4, 1.5);
  }
  fed.feed(40, 1.0);
  EXPECT_EQ(fed.detections.size(), 1U);
}

TEST(DetectionTracker, TakesWhatComesAfterALongerPauseForAnother) {
  FedTracker fed(fin_whale());
  fed.feed(40, 1.0);
  fed.feed(4, 20.0);
  fed.feed(12, 1.0);
  fed.feed(4, 20.0);
  fed.feed(40, 1.0);
  EXPECT_EQ(fed.detections.size(), 2U);
}

TEST(DetectionTracker, DoesNotTakeWhatLeadsUpToALoudCallForItsBeginning) {
  FedTracker fed(fin_whale());
  fed.feed(40, 1.0);
  fed.feed(8, 15.0);
  fed.feed(4, 400.0);
  fed.feed(40, 1.0);
  ASSERT_EQ(fed.detections.size(), 1U);
  EXPECT_EQ(fed.detections[0].begin, Time{12'000'000});
  EXPECT_EQ(fed.detections[0].duration, Duration::seconds(1));
}

TEST(DetectionTracker, DoesNotTakeNoiseAroundAWeakCallForTheCall) {
  SoundSettings settings = fin_whale();
  settings.detection_threshold = Decibels{6};
  FedTracker fed(settings);
  fed.feed(40, 1.0);
  fed.feed(4, 7.3);  // 8 dB: a tenth of it is less than the noise
  fed.feed(40, 1.0);
  ASSERT_EQ(fed.detections.size(), 1U);
  EXPECT_EQ(fed.detections[0].begin, Time{10'000'000});
  EXPECT_EQ(fed.detections[0].duration, Duration::seconds(1));
}

TEST(DetectionTracker, TakesTheLoudestOfASoundAsFaintAsNoise) {
  SoundSettings settings = fin_whale();
  settings.detection_threshold = Decibels{0};
  FedTracker fed(settings);
  fed.feed(40, 1.0);
  fed.feed(4, 2.1);
  fed.feed(40, 1.0);
  ASSERT_EQ(fed.detections.size(), 1U);
  EXPECT_EQ(fed.detections[0].begin, Time{10'000'000});
  EXPECT_EQ(fed.detections[0].duration, Duration::seconds(1));
}

TEST(DetectionTracker, DoesNotGoOnThroughNoiseHoweverLowItsThreshold) {
  SoundSettings settings = fin_whale();
  settings.detection_threshold = Decibels{2};
  FedTracker fed(settings);
  fed.feed(40, 1.0);
  for (int call = 0; call < 3; ++call) {
    fed.feed(4, 20.0);
    fed.feed(40, 1.5);  // -3 dB: noise of 30 degrees of freedom is that loud in one of 25 integration times
  }
  EXPECT_EQ(fed.detections.size(), 3U);
}

TEST(DetectionTracker, TellsWhatIsNotOverAtTheEnd) {
  FedTracker fed(fin_whale());
  fed.feed(40, 1.0);
  fed.feed(8, 20.0);
  EXPECT_TRUE(fed.detections.empty());
  fed.finish();
  ASSERT_EQ(fed.detections.size(), 1U);
  EXPECT_EQ(fed.detections[0].duration, Duration::seconds(2));
  fed.finish();
  EXPECT_EQ(fed.detections.size(), 1U) << "once";
}

TEST(DetectionTracker, AsksForMOfTheLastN) {
  SoundSettings settings = fin_whale();
  settings.m_of_n = {.m = 5, .n = 8};
  FedTracker fed(settings);
  fed.feed(40, 1.0);
  fed.feed(1, 60.0);  // in four estimates
  fed.feed(40, 1.0);
  EXPECT_EQ(fed.detections.size(), 0U);
  fed.feed(4, 60.0);
  fed.feed(40, 1.0);
  fed.finish();
  EXPECT_EQ(fed.detections.size(), 1U);
}

TEST(DetectionTracker, SaysThatItHoldsClippedEstimates) {
  FedTracker fed(fin_whale());
  fed.feed(40, 1.0);
  fed.feed(4, 60.0, Hearing::kClipped);
  fed.feed(40, 1.0);
  ASSERT_EQ(fed.detections.size(), 1U);
  EXPECT_EQ(fed.detections[0].worst, Hearing::kClipped);
}

TEST(DetectionTracker, TakesDeafnessForAPause) {
  FedTracker fed(fin_whale());
  fed.feed(40, 1.0);
  fed.feed(8, 60.0);
  fed.feed(12, 60.0, Hearing::kDropout);
  fed.feed(8, 60.0);
  fed.finish();
  EXPECT_EQ(fed.detections.size(), 2U);
}

}  // namespace
}  // namespace earshot::detector
