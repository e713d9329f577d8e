#include "sim/spectrum/spectrogram.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/sim/spectrum/tone.hpp"

namespace earshot::spectrum {
namespace {

using tests::tone;

TEST(Spectrogram, HasNoMoreColumnsThanAPictureShowsHoweverLongTheSound) {
  const ShortTimeSpectrum windows(Hertz{1000}, 2);
  const Spectrogram day(24ULL * 3600 * 1000, windows, Hertz{90});
  EXPECT_EQ(day.columns(), Spectrogram::kMostColumns);
  EXPECT_DOUBLE_EQ(day.seconds_per_column(), 86.4);
  EXPECT_EQ(Spectrogram(1, windows, Hertz{1e6}).rows(), 250U) << "501 bins in twos";
}

TEST(Spectrogram, ShowsAToneWhereAndWhenItSounds) {
  ShortTimeSpectrum windows(Hertz{1000}, 2);
  Spectrogram picture(10'000, windows, Hertz{90});
  std::vector<float> sound(10'000, 1e-4F);
  const std::vector<float> call = tone(0.5, 20.0, 1000.0, 1000);
  std::copy(call.begin(), call.end(), sound.begin() + 5000);
  windows.take(sound, 0, [&picture](std::span<const float> psd, std::uint64_t begin) { picture.take(psd, begin); });
  std::size_t loudest = 0;
  for (std::size_t column = 0; column < picture.columns(); ++column)
    if (picture.level_db(column, 20) > picture.level_db(loudest, 20) || std::isnan(picture.level_db(loudest, 20))) loudest = column;
  EXPECT_NEAR((static_cast<double>(loudest) + 0.5) * picture.seconds_per_column(), 5.5, 0.5);
  EXPECT_GT(picture.level_db(loudest, 20), picture.level_db(loudest, 60) + 60.0);
}

TEST(Spectrogram, PutsARowInTheMiddleOfTheBinsThatItIsTheMeanOf) {
  // Bins of 1 Hz from 0 to 511 Hz in 256 rows: 0 and 1, 2 and 3, ...
  const ShortTimeSpectrum windows(Hertz{2000}, 2);
  const Spectrogram spectrogram(10'000, windows, Hertz{511});
  ASSERT_EQ(spectrogram.hertz_per_row(), Hertz{2});
  EXPECT_EQ(spectrogram.frequency_of(0), Hertz{0.5});
  EXPECT_EQ(spectrogram.frequency_of(10), Hertz{20.5});
}

}  // namespace
}  // namespace earshot::spectrum
