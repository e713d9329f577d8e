#include "sim/recording/riff.hpp"

#include <gtest/gtest.h>

#include <array>
#include <fstream>
#include <string>

#include "tests/sim/recording/wav_bytes.hpp"
#include "tests/support/temporary_folder.hpp"

namespace earshot::recording {
namespace {

using namespace std::string_literals;
using support::TemporaryFolder;
using tests::WavBytes;

RiffData data_of(const std::filesystem::path& path) {
  const std::optional<RiffFile> file = read_riff(path);
  EXPECT_TRUE(file);
  return file ? file->data : RiffData{};
}

/// A format of 16 bit and one channel.
std::string format_chunk() {
  return tests::chunk("fmt ", tests::little_endian(1, 2) + tests::little_endian(1, 2) + tests::little_endian(1000, 4) +
                                  tests::little_endian(2000, 4) + tests::little_endian(2, 2) + tests::little_endian(16, 2));
}

std::string wave(std::uint64_t declared, const std::string& behind) {
  return "RIFF" + tests::little_endian(declared + 36, 4) + "WAVE" + format_chunk() + "data" + tests::little_endian(declared, 4) + behind;
}

TEST(Riff, TellsWhatTheHeaderTellsAndWhatIsThere) {
  const TemporaryFolder folder;
  // An odd chunk has a byte of padding behind it.
  tests::write(
      folder / "a.wav",
      WavBytes{.before_format = tests::chunk("junk", "odd"), .samples = tests::int16_samples(std::array{1, 2}), .declares_more = 100}
          .bytes());
  const RiffData data = data_of(folder / "a.wav");
  EXPECT_EQ(data.declared, 104U);
  EXPECT_EQ(data.there, 4U);
}

TEST(Riff, TakesTheLengthOfAnRf64OrBw64FileFromItsLongHeader) {
  const TemporaryFolder folder;
  const std::string long_sizes = tests::chunk(
      "ds64", tests::little_endian(72, 8) + tests::little_endian(6, 8) + tests::little_endian(3, 8) + tests::little_endian(0, 4));
  for (const std::string kind : {"RF64", "BW64"}) {
    tests::write(folder / "a.wav",
                 kind + tests::little_endian(0xFFFFFFFF, 4) + "WAVE" + long_sizes + "data" + tests::little_endian(0xFFFFFFFF, 4) + "abcd");
    const RiffData data = data_of(folder / "a.wav");
    EXPECT_EQ(data.declared, 6U);
    EXPECT_EQ(data.there, 4U);
  }
}

TEST(Riff, TakesSubstitutesForNoLengthAndWhatFollowsForSamples) {
  const TemporaryFolder folder;
  const std::string samples(1000, '\1');
  for (const std::uint64_t declared : {0ULL, 0xFFFFFFFFULL, 0xFFFFFFDBULL, 0x7FFFF000ULL, 0x80000000ULL}) {
    tests::write(folder / "a.wav", wave(declared, samples));
    const RiffData data = data_of(folder / "a.wav");
    EXPECT_FALSE(data.declared) << declared;
    EXPECT_EQ(data.there, 1000U) << declared;
    EXPECT_EQ(data.begin, 44U);
  }
  tests::write(folder / "b.wav", "no RIFF file at all");
  EXPECT_FALSE(read_riff(folder / "b.wav"));
}

TEST(Riff, CountsWhatStandsBehindTheToldSizeUnlessItIsChunks) {
  const TemporaryFolder folder;
  const std::string samples(1000, '\1');
  tests::write(folder / "a.wav", wave(400, samples));
  EXPECT_EQ(data_of(folder / "a.wav").declared, 400U);
  EXPECT_EQ(data_of(folder / "a.wav").there, 1000U);
  const std::string chunks = tests::info_chunk({{"ICMT", "odd"}}) + tests::chunk("guan", "GUANO|Version:1.0\n");
  tests::write(folder / "b.wav", wave(1000, samples + chunks));
  EXPECT_EQ(data_of(folder / "b.wav").there, 1000U);
  tests::write(folder / "c.wav", wave(0, chunks));
  EXPECT_EQ(data_of(folder / "c.wav").declared, 0U) << "an empty recording with its texts";
  tests::write(folder / "d.wav", wave(999, samples.substr(1) + chunks));
  EXPECT_EQ(data_of(folder / "d.wav").there, 999U) << "some forget to fill an odd chunk up";
}

TEST(Riff, UnwrapsASizeThat32BitsDoNotHoldUpToTheChunksBehind) {
  const TemporaryFolder folder;
  constexpr std::uint64_t kFourGigabytes = std::uint64_t{1} << 32U;
  tests::write(folder / "a.wav", wave(400, ""));
  std::filesystem::resize_file(folder / "a.wav", 44 + 400 + kFourGigabytes);  // of holes
  std::ofstream(folder / "a.wav", std::ios::binary | std::ios::app) << tests::info_chunk({{"ICMT", "a comment"}});
  EXPECT_EQ(data_of(folder / "a.wav").there, 400 + kFourGigabytes);
  EXPECT_EQ(data_of(folder / "a.wav").declared, 400U);
}

/// A name of Sony Wave64: four letters and a tail.
std::string wave64_name(const std::string& word, const std::string& tail = "\xF3\xAC\xD3\x11\x8C\xD1\x00\xC0\x4F\x8E\xDB\x8A"s) {
  return word + tail;
}

TEST(Riff, ReadsAW64FileWhoseLengthWasNeverWritten) {
  const TemporaryFolder folder;
  const std::string format = format_chunk().substr(8);
  const std::string head = wave64_name("riff", "\x2E\x91\xCF\x11\xA5\xD6\x28\xDB\x04\xC1\x00\x00"s) + tests::little_endian(0, 8) +
                           wave64_name("wave") + wave64_name("fmt ") + tests::little_endian(24 + 16, 8) + format + wave64_name("data");
  for (const std::uint64_t declared : {0ULL, 24ULL, 0x7FFFFFFFFFFFFFFFULL}) {
    tests::write(folder / "a.w64", head + tests::little_endian(declared, 8) + std::string(1000, '\1'));
    EXPECT_FALSE(data_of(folder / "a.w64").declared) << declared;
    EXPECT_EQ(data_of(folder / "a.w64").there, 1000U) << declared;
  }
  tests::write(folder / "b.w64", head + tests::little_endian(24 + 400, 8) + std::string(1000, '\1'));
  EXPECT_EQ(data_of(folder / "b.w64").declared, 400U);
  EXPECT_EQ(data_of(folder / "b.w64").there, 1000U);
}

}  // namespace
}  // namespace earshot::recording
