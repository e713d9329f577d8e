#include "sim/pe/absorber.hpp"
#include "tests/sim/pe/short_section.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace earshot::pe {
namespace {

constexpr Hertz kFrequency{100.0};
constexpr Meters kRange{10'000.0};

ocean::Section over(double sound_speed_mps, double attenuation) {
  return tests::section_of({.floor = {{0.0, 100.0}},
                            .water = {{0.0, ocean::TabulatedProfile{{0.0}, {1500.0}}}},
                            .sediment = {{0.0, {{0.0, sound_speed_mps, 1.5, attenuation}}}}});
}

TEST(Absorber, ReflectsLessThanATenThousandthOfAnyWaveThatMatters) {
  for (const double speed : {1450.0, 1500.0, 1700.0, 3000.0}) {
    for (const double attenuation : {0.0, 0.02, 0.5}) {
      const ocean::Section section = over(speed, attenuation);
      EXPECT_LT(largest_reflection(choose_absorber(section, kFrequency, kRange, {}), section, kFrequency, kRange), 1e-4)
          << speed << attenuation;
    }
  }
}

TEST(Absorber, ReflectsWavesThatDieAwayDownwardAsLittleAsThoseThatTravel) {
  const Absorber absorber = choose_absorber(over(1700.0, 0.02), kFrequency, kRange, {});
  for (const double wavenumber : {0.02, 0.1, 0.3}) EXPECT_LT(absorber.reflection({0.0, wavenumber}), 1e-4) << wavenumber;
}

TEST(Absorber, OfOneElementReflectsAsItsClosedForm) {
  // An element twice as long as a wave's 1/k: half = i/2 x 2 exp(i pi/4) = (-1 + i)/sqrt(2), and |(1 + half)/(1 - half)|^2 is
  // (2 - sqrt(2))/(2 + sqrt(2)) = (sqrt(2) - 1)^2.
  const Absorber one{.shortest_m = 2.0, .growth = 1.5, .elements = 1};
  EXPECT_NEAR(one.reflection({1.0, 0.0}), std::pow(std::sqrt(2.0) - 1.0, 2), 1e-15);  // a few roundings
}

TEST(Absorber, IsThickerTheLessTheSeabedLosesAndTheFurtherTheSoundGoes) {
  const auto thickness = [](double attenuation, Meters range) {
    return choose_absorber(over(1500.0, attenuation), kFrequency, range, {}).thickness_m();
  };
  EXPECT_GT(thickness(0.02, kRange), 3.0 * thickness(0.5, kRange));        // the root of 25, less the rounding to a whole element of 1.5
  EXPECT_GT(thickness(0.0, 16.0 * kRange), 2.6 * thickness(0.0, kRange));  // the root of 16, likewise
}

TEST(Absorber, IsThickEnoughForTheFastestAndFineEnoughForTheSlowestOfSeveralSeabeds) {
  ocean::Section both = over(1500.0, 0.5);
  const ocean::Section fast = over(3000.0, 0.5);
  both.sediment.push_back({.range = Meters{5'000.0}, .layers = fast.sediment.front().layers});
  const Absorber asked = choose_absorber(both, kFrequency, kRange, 12.0);
  EXPECT_GE(asked.thickness_m(), 12.0 * 3000.0 / kFrequency.value) << "wavelengths of the fastest";
  EXPECT_EQ(asked.shortest_m, choose_absorber(over(1500.0, 0.5), kFrequency, kRange, {}).shortest_m);
}

TEST(Absorber, IsAsThickAsAsked) {
  const double wavelength_m = 1700.0 / kFrequency.value;
  const Absorber absorber = choose_absorber(over(1700.0, 0.5), kFrequency, kRange, 12.0);
  EXPECT_GE(absorber.thickness_m(), 12.0 * wavelength_m);
  EXPECT_LE(absorber.thickness_m(), 1.6 * 12.0 * wavelength_m);  // by less than one element, which is half as long again as the one before
}

}  // namespace
}  // namespace earshot::pe
