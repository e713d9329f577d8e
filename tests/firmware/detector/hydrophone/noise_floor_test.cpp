#include "firmware/detector/hydrophone/noise_floor.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/gaussian_noise.hpp"

namespace earshot::detector {
namespace {

constexpr int kDegrees = 30;

/// Power of noise of mean one: a chi-square variable over its degrees of freedom.
class NoisePower {
 public:
  explicit NoisePower(std::uint64_t seed) : noise_(seed) {}
  float operator()() {
    float sum = 0.0F;
    for (int i = 0; i < kDegrees; ++i) {
      const float x = noise_();
      sum += x * x;
    }
    return sum / static_cast<float>(kDegrees);
  }

 private:
  support::GaussianNoise noise_;
};

double db(double power) {
  return 10.0 * std::log10(power);
}

NoiseFloor floor_of(std::size_t memory) {
  NoiseFloor floor;
  floor.configure(memory, kDegrees);
  return floor;
}

TEST(NoiseFloor, IsTheMeanPowerOfNoise) {
  for (const std::size_t memory : {16U, 120U, 121U, 512U}) {
    NoiseFloor floor = floor_of(memory);
    NoisePower power(memory);
    double sum = 0.0;
    int count = 0;
    for (int i = 0; i < 60'000; ++i) {
      floor.take(power());
      if (floor.known() < memory) continue;
      sum += floor.power();
      ++count;
    }
    EXPECT_NEAR(db(sum / count), 0.0, 0.03) << memory;  // Wilson and Hilferty's median is good to 0.005 dB; the rest is chance
  }
}

TEST(NoiseFloor, IgnoresCallsThatFillLessThanHalfOfItsMemory) {
  NoiseFloor floor = floor_of(120);
  NoisePower power(1);
  for (int i = 0; i < 120; ++i) floor.take(power());
  const double before = db(floor.power());
  for (int i = 0; i < 20; ++i) floor.take(1000.0F);  // a call of 20 s, 30 dB over the noise
  EXPECT_NEAR(db(floor.power()), before, 0.35);      // the docstring's: a sixth of calls lifts to the 0.6 quantile, 0.28 dB
  for (int i = 0; i < 35; ++i) floor.take(1000.0F);
  EXPECT_LT(db(floor.power()), 4.0) << "less than half";
  for (int i = 0; i < 10; ++i) floor.take(1000.0F);
  EXPECT_GT(db(floor.power()), 29.0) << "more than half";
}

TEST(NoiseFloor, IsLiftedAsLittleByRegularCallsAsItSays) {
  for (const auto& [one_of, lifted_db] : {std::pair{10, 0.3}, std::pair{4, 0.8}}) {
    NoiseFloor floor = floor_of(120);
    NoisePower power(2);
    double sum = 0.0;
    for (int i = 0; i < 20'120; ++i) {
      floor.take(i % one_of == 0 ? 1000.0F : power());
      if (i >= 120) sum += floor.power();
    }
    EXPECT_LT(db(sum / 20'000), lifted_db) << one_of;
  }
}

TEST(NoiseFloor, HasTheNewNoiseOnceHalfOfItsMemoryIsNew) {
  NoiseFloor floor = floor_of(120);
  for (int i = 0; i < 120; ++i) floor.take(1.0F);
  for (int i = 0; i < 60; ++i) floor.take(100.0F);
  EXPECT_LT(db(floor.power()), 1.0);
  floor.take(100.0F);
  EXPECT_NEAR(db(floor.power()), 20.0, 0.2);
}

TEST(NoiseFloor, KnowsNothingAtFirst) {
  NoiseFloor floor = floor_of(16);
  EXPECT_EQ(floor.known(), 0U);
  EXPECT_EQ(floor.power(), 0.0);
  for (int i = 0; i < 40; ++i) floor.take(0.0F);
  EXPECT_EQ(floor.known(), 16U);
  EXPECT_EQ(floor.power(), 0.0);
}

}  // namespace
}  // namespace earshot::detector
