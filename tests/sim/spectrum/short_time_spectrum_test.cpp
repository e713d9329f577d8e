#include "sim/spectrum/short_time_spectrum.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "sim/spectrum/third_octaves.hpp"
#include "tests/sim/spectrum/tone.hpp"

namespace earshot::spectrum {
namespace {

using tests::tone;

TEST(ShortTimeSpectrum, HoldsTheMeanSquareOfATone) {
  ShortTimeSpectrum windows(Hertz{1000}, 2);
  int count = 0;
  windows.take(tone(0.5, 20.3, 1000.0, 3000), 0, [&](std::span<const float> psd, std::uint64_t begin) {
    EXPECT_EQ(begin, 500U * static_cast<std::uint64_t>(count));
    const double sum = std::accumulate(psd.begin(), psd.end(), 0.0) * windows.bin_width().value;
    // 0.5^2 / 2; what the window leaves of the term at twice the frequency, and a float's rounding, are far less.
    EXPECT_NEAR(sum, 0.125, 1e-4);
    EXPECT_NEAR(power_in(psd, windows.bin_width(), Hertz{15}, Hertz{30}), 0.125, 1e-4);
    EXPECT_LT(power_in(psd, windows.bin_width(), Hertz{40}, Hertz{400}), 1e-8);
    ++count;
  });
  EXPECT_EQ(count, 5) << "windows of a second that begin every half";
}

TEST(ShortTimeSpectrum, BeginsAnewWhereSoundDoesNotGoOn) {
  ShortTimeSpectrum windows(Hertz{1000}, 2);
  int count = 0;
  const auto sink = [&count](std::span<const float>, std::uint64_t begin) {
    EXPECT_EQ(begin, 2000U);
    ++count;
  };
  windows.take(tone(0.5, 20.0, 1000.0, 999), 0, sink);
  windows.take(tone(0.5, 20.0, 1000.0, 1000), 2000, sink);
  EXPECT_EQ(count, 1);
}

TEST(ShortTimeSpectrum, IsALittleShorterThanASecondWhereThatIsFaster) {
  EXPECT_EQ(ShortTimeSpectrum(Hertz{48'000}, 2).length(), 48'000U);
  EXPECT_EQ(ShortTimeSpectrum(Hertz{44'100}, 2).length(), 43'740U);  // 2^2 3^7 5; 44 100 has sevens
}

}  // namespace
}  // namespace earshot::spectrum
