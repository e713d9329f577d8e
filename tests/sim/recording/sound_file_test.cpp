#include "sim/recording/sound_file.hpp"

#include <gtest/gtest.h>
#include <sndfile.h>

#include <array>
#include <cmath>
#include <fstream>
#include <limits>
#include <vector>

#include "firmware/host/file/bad_input.hpp"
#include "tests/sim/recording/wav_bytes.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot::recording {
namespace {

using support::TemporaryFolder;
using tests::WavBytes;

std::vector<float> all_of(SoundFile& file) {
  std::vector<float> samples(1000);
  samples.resize(file.read(std::span(samples).first(samples.size() / file.format().channels * file.format().channels)) *
                 file.format().channels);
  return samples;
}

std::string refusal_of(const std::filesystem::path& path) {
  try {
    const SoundFile file(path);
    return "taken";
  } catch (const host::BadInput& e) {
    return std::string(e.what()).substr(path.string().size());
  }
}

TEST(SoundFile, GivesSharesOfFullScale) {
  const TemporaryFolder folder;
  tests::write(folder / "a.wav", WavBytes{.samples = tests::int16_samples(std::array{0, 16384, -32768, 32767})}.bytes());
  SoundFile file(folder / "a.wav");
  EXPECT_EQ(file.format().sample_rate, Hertz{2000});
  EXPECT_EQ(file.format().bits, 16);
  EXPECT_EQ(all_of(file), (std::vector<float>{0.0F, 0.5F, -1.0F, 32767.0F / 32768.0F}));
}

TEST(SoundFile, Reads24BitsAndSeveralChannels) {
  const TemporaryFolder folder;
  const std::string frame = tests::little_endian(0x400000, 3) + tests::little_endian(0xC00000, 3) + tests::little_endian(1, 3);
  tests::write(folder / "a.wav", WavBytes{.channels = 3, .bits = 24, .samples = frame + frame}.bytes());
  SoundFile file(folder / "a.wav");
  EXPECT_EQ(file.format().channels, 3U);
  EXPECT_EQ(file.format().bits, 24);
  EXPECT_EQ(file.frames(), 2U);
  EXPECT_EQ(all_of(file), (std::vector<float>{0.5F, -0.5F, 1.0F / 8388608.0F, 0.5F, -0.5F, 1.0F / 8388608.0F}));
}

TEST(SoundFile, LeavesFloatingPointAsItStands) {
  const TemporaryFolder folder;
  const float nan = std::numeric_limits<float>::quiet_NaN();
  tests::write(folder / "a.wav",
               WavBytes{.bits = 32, .format = 3, .samples = tests::float_samples(std::array{-1522.5F, 0.25F, nan})}.bytes());
  SoundFile file(folder / "a.wav");
  const std::vector<float> samples = all_of(file);
  ASSERT_EQ(samples.size(), 3U);
  EXPECT_EQ(samples[0], -1522.5F);
  EXPECT_EQ(samples[1], 0.25F);
  EXPECT_TRUE(std::isnan(samples[2]));
  EXPECT_EQ(largest_magnitude(folder / "a.wav", [] {}), 1522.5) << "a NaN is not the largest";
}

/// 16 bit, by libsndfile: FLAC is not written by hand.
void write_flac(const std::filesystem::path& path, const std::vector<short>& samples) {
  SF_INFO info{.frames = 0, .samplerate = 2000, .channels = 1, .format = SF_FORMAT_FLAC | SF_FORMAT_PCM_16, .sections = 0, .seekable = 0};
  SNDFILE* file = sf_open(path.c_str(), SFM_WRITE, &info);
  ASSERT_NE(file, nullptr);
  sf_set_string(file, SF_STR_COMMENT, "Recorded at 19:17:30 24/09/2019 (UTC) by AudioMoth 0");
  sf_write_short(file, samples.data(), static_cast<sf_count_t>(samples.size()));
  sf_close(file);
}

TEST(SoundFile, ReadsFlacWithItsComment) {
  const TemporaryFolder folder;
  write_flac(folder / "a.flac", {0, 16384, -32768});
  SoundFile file(folder / "a.flac");
  EXPECT_EQ(file.texts().comment, "Recorded at 19:17:30 24/09/2019 (UTC) by AudioMoth 0");
  EXPECT_EQ(all_of(file), (std::vector<float>{0.0F, 0.5F, -1.0F}));
}

// Its STREAMINFO tells the samples in 36 bits from the lower half of the file's byte 21 on; 0 is "not known" (RFC 9639, 8.2).
TEST(SoundFile, CountsTheSamplesOfAFlacThatDoesNotTellThem) {
  const TemporaryFolder folder;
  write_flac(folder / "a.flac", {0, 16384, -32768});
  std::fstream file(folder / "a.flac", std::ios::binary | std::ios::in | std::ios::out);
  file.seekg(21);
  const char byte = static_cast<char>(file.get() & 0xF0);
  file.seekp(21);
  file.write(std::array<char, 5>{byte, 0, 0, 0, 0}.data(), 5);
  file.close();
  SoundFile unknown(folder / "a.flac");
  EXPECT_EQ(unknown.frames(), 3U);
  EXPECT_EQ(unknown.declared_length(), DeclaredLength::kUnknown) << "a recorder that was killed leaves such a file, too";
  EXPECT_EQ(all_of(unknown), (std::vector<float>{0.0F, 0.5F, -1.0F}));
}

TEST(SoundFile, ReadsTheTextsThatAnIcListenWritesBeforeTheFormat) {
  const TemporaryFolder folder;
  const std::string info = tests::info_chunk({{"IART", "Ocean Sonics icListen HF #1234"},
                                              {"IPRD", "RB9-ETH R8"},
                                              {"ICRD", "2024-06-01T05:31:14"},
                                              {"ICMT", "3.000000 V pk, -177 dBV re 1uPa, 32768 = Max Count"}});
  tests::write(folder / "a.wav", WavBytes{.before_format = info, .samples = tests::int16_samples(std::array{1, 2})}.bytes());
  const SoundFile file(folder / "a.wav");
  EXPECT_EQ(file.texts().artist, "Ocean Sonics icListen HF #1234");
  EXPECT_EQ(file.texts().date, "2024-06-01T05:31:14");
  EXPECT_TRUE(support::tells(file.texts().comment, {"3.000000", "V", "-177 dBV", "1uPa", "32768"}));
}

TEST(SoundFile, TellsHowMuchIsMissingOfAFileThatWasCutShort) {
  const TemporaryFolder folder;
  tests::write(folder / "a.wav", WavBytes{.samples = tests::int16_samples(std::array{1, 2, 3, 4}), .declares_more = 12}.bytes());
  SoundFile file(folder / "a.wav");
  EXPECT_EQ(file.frames(), 4U);
  EXPECT_EQ(file.missing_frames(), 6U);
  EXPECT_EQ(all_of(file).size(), 4U);
}

TEST(SoundFile, ReadsWhatStandsBehindTheEndThatTheHeaderTells) {
  const TemporaryFolder folder;
  for (const std::string kind : {"RIFF", "RF64", "BW64"}) {
    std::string bytes = WavBytes{.samples = tests::int16_samples(std::array{16384, -16384, 8192, -8192, 0, 0})}.bytes();
    bytes.replace(0, 4, kind);
    bytes.replace(bytes.size() - 16, 4, tests::little_endian(2, 4));
    tests::write(folder / "a.wav", bytes);
    SoundFile file(folder / "a.wav");
    EXPECT_EQ(file.declared_length(), DeclaredLength::kTooShort) << kind;
    EXPECT_EQ(file.frames_behind(), 5U);
    EXPECT_EQ(file.frames(), 6U);
    EXPECT_EQ(all_of(file), (std::vector<float>{0.5F, -0.5F, 0.25F, -0.25F, 0.0F, 0.0F}));
    ASSERT_TRUE(file.go_to(2));
    EXPECT_EQ(all_of(file), (std::vector<float>{0.25F, -0.25F, 0.0F, 0.0F}));
  }
}

TEST(SoundFile, ReadsAllOfAFileWhoseLengthWasNeverWritten) {
  const TemporaryFolder folder;
  const std::string whole = tests::int16_samples(std::array{16384, -16384, 8192, 0});
  const std::string floating = tests::float_samples(std::array{0.5F, -0.5F, 0.25F, 0.0F});
  const std::string three_bytes =
      tests::little_endian(0x400000, 3) + tests::little_endian(0xC00000, 3) + tests::little_endian(0x200000, 3) + std::string(3, '\0');
  for (const WavBytes& wav :
       {WavBytes{.samples = whole}, WavBytes{.bits = 32, .format = 3, .samples = floating}, WavBytes{.bits = 24, .samples = three_bytes}}) {
    for (const std::uint64_t declared : {0ULL, 0xFFFFFFFFULL}) {
      std::string bytes = wav.bytes();
      bytes.replace(bytes.size() - wav.samples.size() - 4, 4, tests::little_endian(declared, 4));
      tests::write(folder / "a.wav", bytes);
      SoundFile file(folder / "a.wav");
      EXPECT_EQ(file.declared_length(), DeclaredLength::kUnknown);
      EXPECT_EQ(all_of(file), (std::vector<float>{0.5F, -0.5F, 0.25F, 0.0F}));
    }
  }
}

TEST(SoundFile, SaysHowFloatingPointIsStored) {
  const TemporaryFolder folder;
  tests::write(folder / "a.wav", WavBytes{.bits = 32, .format = 3, .samples = tests::float_samples(std::array{0.5F})}.bytes());
  EXPECT_EQ(to_string(SoundFile(folder / "a.wav").format()), "32 bit floating point");
  tests::write(folder / "b.wav", WavBytes{.bits = 64, .format = 3, .samples = std::string(16, '\1')}.bytes());
  EXPECT_EQ(to_string(SoundFile(folder / "b.wav").format()), "64 bit floating point");
  tests::write(folder / "c.wav", WavBytes{.bits = 24, .samples = "abc"}.bytes());
  EXPECT_EQ(to_string(SoundFile(folder / "c.wav").format()), "24 bit");
}

TEST(SoundFile, ReadsTheTextsThatStandBehindTheSamples) {
  const TemporaryFolder folder;
  const std::string bext = std::string(320, '\0') + "2021-02-05" + "03-59-46" + std::string(300, '\0');
  tests::write(folder / "a.wav", WavBytes{.samples = tests::int16_samples(std::array{1, 2})}.bytes() + tests::chunk("bext", bext) +
                                     tests::chunk("guan", "GUANO|Version:1.0\nTimestamp:2021-02-05T03:59:46+10:00\n"));
  const SoundFile file(folder / "a.wav");
  EXPECT_EQ(file.frames(), 2U);
  EXPECT_EQ(file.declared_length(), DeclaredLength::kRight);
  EXPECT_EQ(file.texts().origin, "2021-02-05 03:59:46");
  EXPECT_NE(file.texts().guano.find("Timestamp:2021"), std::string::npos);
}

TEST(SoundFile, RefusesWhatIsNoneWithItsName) {
  const TemporaryFolder folder;
  tests::write(folder / "text.wav", "a text that somebody called a sound\n");
  tests::write(folder / "empty.wav", "");
  tests::write(folder / "silent.wav", WavBytes{}.bytes());
  tests::write(folder / "law.wav", WavBytes{.bits = 8, .format = 7, .samples = "abcdef"}.bytes());
  EXPECT_EQ(refusal_of(folder / "text.wav").substr(0, 37), ": is no sound file that can be read: ");
  EXPECT_EQ(refusal_of(folder / "empty.wav").substr(0, 37), ": is no sound file that can be read: ");
  EXPECT_EQ(refusal_of(folder / "silent.wav"), ": holds no sample");
  EXPECT_EQ(refusal_of(folder / "law.wav").substr(0, 38), ": its samples are coded with loss, whi");
  EXPECT_EQ(refusal_of(folder.path()), ": cannot be read: it is a folder");
  EXPECT_EQ(refusal_of(folder / "nowhere.wav"), ": no such file");
}

}  // namespace
}  // namespace earshot::recording
