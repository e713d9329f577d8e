#include "sim/recording/sequence.hpp"

#include <gtest/gtest.h>

#include <array>
#include <filesystem>

#include "firmware/host/file/bad_input.hpp"
#include "sim/recording/utc.hpp"
#include "tests/sim/recording/wav_bytes.hpp"
#include "tests/support/temporary_folder.hpp"

namespace earshot::recording {
namespace {

using Paths = std::vector<std::filesystem::path>;
using support::TemporaryFolder;
using tests::WavBytes;

/// Ten seconds at 100 Hz, each sample the same.
std::filesystem::path ten_seconds(const std::filesystem::path& path, int value = 1, std::uint32_t rate = 100) {
  tests::write(path, WavBytes{.sample_rate = rate, .samples = tests::int16_samples(std::vector<int>(1000, value))}.bytes());
  return path;
}

std::string refusal_of(const Paths& paths) {
  try {
    const Sequence sequence(paths);
    return "taken";
  } catch (const host::BadInput& e) {
    return e.what();
  }
}

TEST(Sequence, PutsFilesInTheOrderOfTheirTimes) {
  const TemporaryFolder folder;
  const Paths paths = {ten_seconds(folder / "a_20200912_000010.wav"), ten_seconds(folder / "b_20200912_000000.wav")};
  const Sequence sequence(paths);
  EXPECT_EQ(sequence.parts()[0].path, paths[1]);
  EXPECT_EQ(sequence.parts()[1].begin, 1000U);
  EXPECT_TRUE(sequence.parts()[1].follows_on);
  EXPECT_TRUE(sequence.remarks().empty());
  EXPECT_EQ(sequence.duration(), Duration::seconds(20));
}

TEST(Sequence, KeepsTheOrderOfFilesOfWhichOneTellsNoTime) {
  const TemporaryFolder folder;
  const Paths paths = {ten_seconds(folder / "a_20200912_000010.wav"), ten_seconds(folder / "b.wav")};
  const Sequence sequence(paths);
  EXPECT_EQ(sequence.parts()[0].path, paths[0]);
  EXPECT_FALSE(sequence.parts()[1].follows_on);
  ASSERT_EQ(sequence.remarks().size(), 1U);
  EXPECT_NE(sequence.remarks()[0].find("b.wav: whether it follows without a gap is not known"), std::string::npos);
}

TEST(Sequence, TellsGapsAndOverlaps) {
  const TemporaryFolder folder;
  const Sequence sequence({ten_seconds(folder / "a_20200912_000000.wav"), ten_seconds(folder / "b_20200912_000040.wav"),
                           ten_seconds(folder / "c_20200912_000045.wav")});
  const std::vector<std::string> remarks = sequence.remarks();
  ASSERT_EQ(remarks.size(), 2U);
  EXPECT_NE(remarks[0].find("begins 30 s after the end of a_20200912_000000.wav"), std::string::npos) << remarks[0];
  EXPECT_NE(remarks[1].find("begins 5 s before the end of b_20200912_000040.wav"), std::string::npos) << remarks[1];
}

TEST(Sequence, CountsTimeThroughTheSoundAndDatesItByItsFile) {
  const TemporaryFolder folder;
  const Sequence sequence({ten_seconds(folder / "a_20200912_000000.wav"), ten_seconds(folder / "b_20200912_000040.wav")});
  const Sequence::Place place = sequence.place_of(Time{12'500'000});  // 2.5 s into the second
  EXPECT_EQ(place.part, 1U);
  EXPECT_EQ(place.offset, Duration::milliseconds(2500));
  ASSERT_TRUE(place.utc);
  EXPECT_EQ(to_iso(*place.utc), "2020-09-12T00:00:42.500Z");
}

TEST(Sequence, RefusesFilesThatAreNotOfOneRecorder) {
  const TemporaryFolder folder;
  const std::filesystem::path slow = ten_seconds(folder / "slow.wav");
  EXPECT_NE(refusal_of({slow, ten_seconds(folder / "fast.wav", 1, 200)}).find("fast.wav: has 200 Hz, "), std::string::npos);
  tests::write(folder / "two.wav", WavBytes{.sample_rate = 100, .channels = 2, .samples = std::string(400, '\1')}.bytes());
  EXPECT_NE(refusal_of({slow, folder / "two.wav"}).find("two.wav: has 2 channels, "), std::string::npos);
  EXPECT_NE(refusal_of({slow, folder.path() / "." / "slow.wav"}).find("is named twice"), std::string::npos);
}

TEST(SequenceReader, GivesEverySampleOfOneChannelAndSaysWhereSoundDoesNotGoOn) {
  const TemporaryFolder folder;
  const Sequence sequence({ten_seconds(folder / "a_20200912_000000.wav", 8192), ten_seconds(folder / "b_20200912_000040.wav", 16384)});
  SequenceReader reader(sequence, 0, 2.0);
  std::uint64_t next = 0;
  while (const std::optional<Piece> piece = reader.next()) {
    EXPECT_EQ(piece->begin, next);
    EXPECT_EQ(piece->follows_on, next != 0 && next != 1000);
    for (const float sample : piece->samples) EXPECT_EQ(sample, piece->part == 0 ? 0.125F : 0.25F);
    next += piece->samples.size();
  }
  EXPECT_EQ(next, 2000U);
  EXPECT_EQ(reader.missing_frames(), 0U);
}

TEST(SequenceReader, TakesTheChannelThatIsAskedFor) {
  const TemporaryFolder folder;
  tests::write(folder / "a.wav",
               WavBytes{.sample_rate = 100, .channels = 2, .samples = tests::int16_samples(std::array{1, 16384, 2, -16384})}.bytes());
  const Sequence sequence({folder / "a.wav"});
  SequenceReader reader(sequence, 1, 1.0);
  const std::optional<Piece> piece = reader.next();
  ASSERT_TRUE(piece);
  EXPECT_EQ(std::vector<float>(piece->samples.begin(), piece->samples.end()), (std::vector<float>{0.5F, -0.5F}));
}

}  // namespace
}  // namespace earshot::recording
