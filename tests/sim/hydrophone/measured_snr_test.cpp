// The sonar equation from end to end: what is put into the sea as SL - TL - N comes out of the detector as the SNR.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "firmware/detector/hydrophone/sound_detector.hpp"
#include "sim/hydrophone/hydrophone.hpp"

namespace earshot::hydrophone {
namespace {

struct Measurement {
  double time_s;
  double snr_db;
  bool too_faint;
};

/// Every measurement of a vehicle that listens for so long, 15 km from a source of that SNR.
std::vector<Measurement> measurements(const detector::SoundSettings& listening, const Calls& calls, double snr_db, int seconds) {
  const auto sound_detector = std::make_unique<detector::SoundDetector>();
  EXPECT_EQ(sound_detector->configure(listening), Status::kOk);
  HydrophoneSettings settings;
  settings.band = {.low = listening.band.low, .high = listening.band.high};
  settings.calls = calls;
  settings.full_scale = detector::full_scale_level(listening.calibration, {});
  Hydrophone hydrophone(settings, 5);
  Situation situation{.arrivals = {}, .speed = MetersPerSecond{2.0}};
  (void)situation.arrivals.push_back({.range = Meters{15'000}, .level = settings.noise_level + Decibels{snr_db}});
  hydrophone.begin(situation);
  std::vector<Measurement> seen;
  for (int t = 1; t <= seconds; ++t) {
    EXPECT_TRUE(hydrophone.hear(situation, Time{} + Duration::seconds(t)));
    sound_detector->hear(hydrophone.block(), hydrophone.samples());
    while (const auto e = sound_detector->next()) {
      if (e->is_measured()) seen.push_back({.time_s = (e->time - Time{}).to_seconds(), .snr_db = e->snr.value, .too_faint = e->too_faint});
    }
  }
  return seen;
}

double mean_snr(const std::vector<Measurement>& seen) {
  double sum = 0.0;
  double count = 0.0;
  for (const Measurement& measurement : seen) {
    if (measurement.too_faint) continue;
    sum += measurement.snr_db;
    count += 1.0;
  }
  return sum / count;
}

TEST(MeasuredSnr, OfASteadyToneIsTheModelled) {
  // From 400 independent measurements of a standard deviation of 1 dB or less; the detector's noise floor and the noise's knee at 20 Hz
  // make 0.2 dB.
  for (const double snr_db : {5.0, 10.0, 20.0, 35.0})
    EXPECT_NEAR(mean_snr(measurements(detector::continuous_tone(), Tone{}, snr_db, 1700)), snr_db, 0.5) << snr_db;
}

TEST(MeasuredSnr, OfASongsPulsesIsTheModelledWhenItIsLoudest) {
  const Song song{.pattern = {.interval_s = 15.0, .song_s = 1e6, .pause_s = 0.0, .listening_s = 1.0}};
  for (const double snr_db : {10.0, 20.0}) {
    std::vector<double> loudest(40, -100.0);  // pulses come at 10, 25, 40, ... s: 15 km take 10 s
    for (const Measurement& measurement : measurements(detector::fin_whale(), song, snr_db, 600)) {
      double& so_far = loudest.at(static_cast<std::size_t>((measurement.time_s - 5.0) / 15.0));
      if (!measurement.too_faint) so_far = std::max(so_far, measurement.snr_db);
    }
    double sum = 0.0;
    for (std::size_t pulse = 10; pulse < 39; ++pulse) sum += loudest[pulse] / 29.0;
    EXPECT_NEAR(sum, snr_db, 0.5) << snr_db;  // standard deviation 0.6 dB at 10 dB: 0.1 dB of 29
  }
}

TEST(MeasuredSnr, OfWhatIsFarUnderTheNoiseIsTooFaint) {
  const std::vector<Measurement> seen = measurements(detector::continuous_tone(), Tone{}, -20.0, 1700);
  const auto measured = std::count_if(seen.begin(), seen.end(), [](const Measurement& measurement) { return !measurement.too_faint; });
  EXPECT_LT(static_cast<double>(measured),
            0.01 * static_cast<double>(seen.size()));  // a thousandth by the detector's word; measurements overlap
}

TEST(MeasuredSnr, IsTheSameInTheSameSea) {
  const auto once = measurements(detector::continuous_tone(), Tone{}, 8.0, 300);
  const auto again = measurements(detector::continuous_tone(), Tone{}, 8.0, 300);
  ASSERT_EQ(once.size(), again.size());
  EXPECT_TRUE(
      std::equal(once.begin(), once.end(), again.begin(), [](const Measurement& a, const Measurement& b) { return a.snr_db == b.snr_db; }));
}

}  // namespace
}  // namespace earshot::hydrophone
