#include "sim/recording/riff.hpp"

#include <gtest/gtest.h>

#include <array>

#include "tests/sim/recording/wav_bytes.hpp"
#include "tests/support/temporary_folder.hpp"

namespace earshot::recording {
namespace {

using support::TemporaryFolder;
using tests::WavBytes;

TEST(Riff, TellsWhatTheHeaderTellsAndWhatIsThere) {
  const TemporaryFolder folder;
  // An odd chunk has a byte of padding behind it.
  tests::write(
      folder / "a.wav",
      WavBytes{.before_format = tests::chunk("junk", "odd"), .samples = tests::int16_samples(std::array{1, 2}), .told_more = 100}.bytes());
  const std::optional<RiffData> data = riff_data(folder / "a.wav");
  ASSERT_TRUE(data);
  EXPECT_EQ(data->told, 104U);
  EXPECT_EQ(data->there, 4U);
}

TEST(Riff, TakesTheLengthOfAnRf64FileFromItsLongHeader) {
  const TemporaryFolder folder;
  const std::string long_sizes = tests::chunk(
      "ds64", tests::little_endian(72, 8) + tests::little_endian(6, 8) + tests::little_endian(3, 8) + tests::little_endian(0, 4));
  tests::write(folder / "a.wav",
               "RF64" + tests::little_endian(0xFFFFFFFF, 4) + "WAVE" + long_sizes + "data" + tests::little_endian(0xFFFFFFFF, 4) + "abcd");
  const std::optional<RiffData> data = riff_data(folder / "a.wav");
  ASSERT_TRUE(data);
  EXPECT_EQ(data->told, 6U);
  EXPECT_EQ(data->there, 4U);
}

TEST(Riff, KnowsNothingOfALengthThatAPipeDidNotKnow) {
  const TemporaryFolder folder;
  const std::string head = "RIFF" + tests::little_endian(0xFFFFFFFF, 4) + "WAVE" + "data" + tests::little_endian(0xFFFFFFFF, 4);
  tests::write(folder / "a.wav", head + "abcd");
  tests::write(folder / "b.wav", "no RIFF file at all");
  EXPECT_FALSE(riff_data(folder / "a.wav"));
  EXPECT_FALSE(riff_data(folder / "b.wav"));
}

}  // namespace
}  // namespace earshot::recording
