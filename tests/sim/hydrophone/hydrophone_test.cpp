#include "sim/hydrophone/hydrophone.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <complex>
#include <cstdlib>
#include <new>
#include <numbers>
#include <vector>

#include "tests/sim/hydrophone/spectrum.hpp"

namespace {
std::atomic<std::size_t> allocations{0};
}  // namespace

// Neither is inlined: GCC 12 would see one half of a pair only, free() take what `new` gave, and refuse.
[[gnu::noinline]] void* operator new(std::size_t size) {
  ++allocations;
  if (void* memory = std::malloc(size)) return memory;  // NOLINT: the counting allocator itself
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* memory) noexcept {
  std::free(memory);
}  // NOLINT
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}  // NOLINT

namespace earshot::hydrophone {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr Decibels kSilence{-100.0};

/// A sea in which nothing but the calls is heard.
HydrophoneSettings silent_sea() {
  return {.noise_level = kSilence, .self_noise = {.at_two_mps = kSilence}};
}

Situation at(Meters range, Decibels level, MetersPerSecond speed = MetersPerSecond{2.0}) {
  Situation situation{.arrivals = {}, .speed = speed};
  (void)situation.arrivals.push_back({.range = range, .level = level});
  return situation;
}

Situation alone(MetersPerSecond speed) {
  return {.arrivals = {}, .speed = speed};
}

/// Pressure in uPa, second after second; blocks that get lost are left out.
template <class SituationAt>
std::vector<double> listen(Hydrophone& hydrophone, Decibels full_scale, int seconds, SituationAt situation_at) {
  std::vector<double> pressure;
  const double upa = std::pow(10.0, full_scale.value / 20.0);
  hydrophone.begin(situation_at(0));
  for (int t = 1; t <= seconds; ++t) {
    if (!hydrophone.hear(situation_at(t), Time{} + Duration::seconds(t))) continue;
    for (const float share : hydrophone.samples()) pressure.push_back(upa * static_cast<double>(share));
  }
  return pressure;
}

double level_of(std::span<const double> pressure) {
  double sum = 0.0;
  for (const double p : pressure) sum += p * p;
  return 10.0 * std::log10(sum / static_cast<double>(pressure.size()));
}

TEST(Hydrophone, HearsAToneAtItsReceivedLevel) {
  Hydrophone hydrophone(silent_sea(), 1);
  const auto pressure = listen(hydrophone, silent_sea().full_scale, 10, [](int) { return at(Meters{5000}, Decibels{120}); });
  EXPECT_NEAR(level_of(pressure), 120.0, 0.001);
}

TEST(Hydrophone, HearsACallAsLongAfterItAsSoundTakes) {
  // Pulses leave at 0 and 15 s; over 12 km at 1500 m/s they come at 8 and 23 s, and last a second.
  HydrophoneSettings settings = silent_sea();
  settings.calls = Song{.pattern = {.interval_s = 15.0, .song_s = 900.0, .pause_s = 300.0, .listening_s = 1.0}};
  Hydrophone hydrophone(settings, 1);
  const auto pressure = listen(hydrophone, settings.full_scale, 30, [](int) { return at(Meters{12'000}, Decibels{120}); });
  const std::span<const double> sound(pressure);
  for (const std::size_t second : {0U, 7U, 9U, 22U, 24U}) EXPECT_LT(level_of(sound.subspan(second * 1000, 1000)), 10.0) << second;
  EXPECT_NEAR(level_of(sound.subspan(8'000, 1000)), 120.0, 0.01);
  EXPECT_NEAR(level_of(sound.subspan(23'000, 1000)), 120.0, 0.01);
}

TEST(Hydrophone, HearsTheDopplerShiftOfItsOwnMotion) {
  // Away at 3 m/s: 20 Hz (1 - 3 / 1500) = 19.96 Hz. A whole number of its turns in 100 s, so that Fourier's sum has it all in one line.
  Hydrophone hydrophone(silent_sea(), 1);
  const auto pressure = listen(hydrophone, silent_sea().full_scale, 100, [](int t) { return at(Meters{5000.0 + 3.0 * t}, Decibels{120}); });
  std::complex<double> line;
  for (std::size_t i = 0; i < pressure.size(); ++i)
    line += pressure[i] * std::polar(1.0, -2.0 * kPi * 19.96 * static_cast<double>(i) / 1000.0) / static_cast<double>(pressure.size());
  EXPECT_NEAR(20.0 * std::log10(std::sqrt(2.0) * std::abs(line)), 120.0, 0.001);
}

TEST(Hydrophone, HearsNoClickWhenRangeAndLevelChange) {
  // To and fro by 20 m and 6 dB a second: the second difference of a tone of 20 Hz is at most A (2 pi 20 / 1000)^2; a click is many times
  // that.
  Hydrophone hydrophone(silent_sea(), 1);
  const auto pressure = listen(hydrophone, silent_sea().full_scale, 20,
                               [](int t) { return at(Meters{t % 2 == 0 ? 5000.0 : 5020.0}, Decibels{t % 2 == 0 ? 114.0 : 120.0}); });
  const double amplitude = std::sqrt(2.0) * 1e6;
  const double most = amplitude * std::pow(2.0 * kPi * 20.0 * (1.0 + 20.0 / 1500.0) / 1000.0, 2);
  double worst = 0.0;
  for (std::size_t i = 1; i + 1 < pressure.size(); ++i)
    worst = std::max(worst, std::abs(pressure[i - 1] - 2 * pressure[i] + pressure[i + 1]));
  EXPECT_LT(worst, 1.15 * most);  // where the pace changes the slope does: by 2 * 20/1500 of a step's
}

TEST(Hydrophone, AddsTwoSourcesAsPowers) {
  // Two tones are powers that add where they differ: one goes away at 7.5 m/s, and is heard at 19.9 Hz.
  Hydrophone hydrophone(silent_sea(), 1);
  const auto pressure = listen(hydrophone, silent_sea().full_scale, 100, [](int t) {
    Situation situation = at(Meters{5000}, Decibels{120});
    (void)situation.arrivals.push_back({.range = Meters{5000.0 + 7.5 * t}, .level = Decibels{120}});
    return situation;
  });
  EXPECT_NEAR(level_of(pressure), 123.01, 0.01);
}

TEST(Hydrophone, HearsTheSeaAtItsLevel) {
  const HydrophoneSettings settings{.noise_level = Decibels{90}, .self_noise = {.at_two_mps = kSilence}};
  Hydrophone hydrophone(settings, 1);
  const auto pressure = listen(hydrophone, settings.full_scale, 600, [](int) { return alone(MetersPerSecond{2}); });
  EXPECT_NEAR(10.0 * std::log10(power_in(settings.band, pressure, settings.sample_rate)), 90.0,
              0.15);  // 18 000 degrees of freedom: 0.046 dB
}

TEST(SelfNoise, RisesByEighteenDecibelsWhenTheSpeedDoubles) {
  const SelfNoise own{.at_two_mps = Decibels{65}};
  EXPECT_NEAR(own.level(MetersPerSecond{2}).value, 65.0, 1e-12);
  EXPECT_NEAR(own.level(MetersPerSecond{4}).value, 83.06, 0.01);
  EXPECT_LT(own.level(MetersPerSecond{0}).value, -1000.0);
}

TEST(Hydrophone, HearsItsOwnWayThroughTheWaterBesidesTheSea) {
  // Own noise as loud as the sea: 3.01 dB more than the sea alone. The same numbers are drawn, so that the ratio is exact.
  const HydrophoneSettings settings{.noise_level = Decibels{90}, .self_noise = {.at_two_mps = Decibels{90}}};
  Hydrophone still(settings, 1);
  Hydrophone under_way(settings, 1);
  const double sea = level_of(listen(still, settings.full_scale, 5, [](int) { return alone(MetersPerSecond{0}); }));
  const double both = level_of(listen(under_way, settings.full_scale, 5, [](int) { return alone(MetersPerSecond{2}); }));
  EXPECT_NEAR(both - sea, 3.0103, 1e-3);
}

TEST(Hydrophone, CountsWhatItsConverterClips) {
  // A tone 3.01 dB under full scale as root mean square just reaches it; 6 dB louder, it lies beyond for 2/3 of the time.
  HydrophoneSettings settings = silent_sea();
  Hydrophone hydrophone(settings, 1);
  hydrophone.begin(at(Meters{1500}, settings.full_scale - Decibels{3.1}));
  (void)hydrophone.hear(at(Meters{1500}, settings.full_scale - Decibels{3.1}), Time{} + Duration::seconds(1));
  EXPECT_EQ(hydrophone.block().overflow_count, 0U);
  hydrophone.begin(at(Meters{1500}, settings.full_scale + Decibels{3.01}));
  (void)hydrophone.hear(at(Meters{1500}, settings.full_scale + Decibels{3.01}), Time{} + Duration::seconds(2));
  EXPECT_NEAR(hydrophone.block().overflow_count, 667, 20);
  for (const float share : hydrophone.samples()) EXPECT_LE(std::abs(share), 1.0F);
}

TEST(Hydrophone, GivesWholeStepsOfItsConverter) {
  HydrophoneSettings settings{.adc_bits = 12};
  Hydrophone hydrophone(settings, 1);
  (void)hydrophone.hear(alone(MetersPerSecond{2}), Time{} + Duration::seconds(1));
  for (const float share : hydrophone.samples()) EXPECT_EQ(share * 2048.0F, std::round(share * 2048.0F));
}

TEST(Hydrophone, DatesAndCountsItsBlocks) {
  Hydrophone hydrophone({}, 1);
  for (int t = 1; t <= 3; ++t) {
    EXPECT_TRUE(hydrophone.hear(alone(MetersPerSecond{2}), Time{} + Duration::seconds(t)));
    EXPECT_EQ(hydrophone.block().time, Time{} + Duration::seconds(t - 1));
    EXPECT_EQ(hydrophone.block().sequence, t - 1);
    EXPECT_EQ(hydrophone.block().first_sample, 1000 * (t - 1));
    EXPECT_EQ(hydrophone.block().samples_per_channel, 1000U);
    EXPECT_EQ(hydrophone.block().channels, 1);
  }
}

TEST(Hydrophone, LosesBlocksAsOftenAsItIsTold) {
  HydrophoneSettings settings;
  settings.loss = 0.2;
  Hydrophone hydrophone(settings, 1);
  int heard = 0;
  for (int t = 1; t <= 1000; ++t) {
    if (!hydrophone.hear(alone(MetersPerSecond{2}), Time{} + Duration::seconds(t))) continue;
    EXPECT_EQ(hydrophone.block().sequence, heard++);
    EXPECT_EQ(hydrophone.block().first_sample, 1000 * (t - 1)) << "what was lost has been counted";
  }
  EXPECT_NEAR(heard, 800, 38);  // three standard deviations, sqrt(1000 * 0.2 * 0.8)
}

TEST(Hydrophone, GivesTheSameSamplesForTheSameSeedAndOthersForAnother) {
  const auto hear = [](std::uint64_t seed) {
    Hydrophone hydrophone({}, seed);
    return listen(hydrophone, Decibels{0}, 10, [](int t) { return at(Meters{5000.0 + t}, Decibels{95}); });
  };
  EXPECT_EQ(hear(7), hear(7));
  EXPECT_NE(hear(7), hear(8));
}

TEST(Hydrophone, AllocatesNothingWhileItHears) {
  Hydrophone hydrophone({}, 1);
  hydrophone.begin(at(Meters{5000}, Decibels{95}));
  const std::size_t before = allocations;
  for (int t = 1; t <= 100; ++t) (void)hydrophone.hear(at(Meters{5000.0 + t}, Decibels{95}), Time{} + Duration::seconds(t));
  EXPECT_EQ(allocations - before, 0U);
  { const std::vector<float> control(1); }
  EXPECT_EQ(allocations - before, 1U) << "the counting allocator does not count";
}

}  // namespace
}  // namespace earshot::hydrophone
