#include "sim/recording/sequence.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "firmware/host/file/bad_input.hpp"
#include "sim/recording/harp.hpp"
#include "sim/recording/sound_folder.hpp"
#include "sim/recording/utc.hpp"
#include "tests/sim/recording/wav_bytes.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text/tells.hpp"

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

TEST(Sequence, OfKnownPartsCountsTimeAsThatOfTheirFilesDoesAndReadsNone) {
  Paths paths;
  const Sequence of_files = [&paths] {
    const TemporaryFolder folder;
    paths = {ten_seconds(folder / "a_20200912_000000.wav"), ten_seconds(folder / "b_20200912_000100.wav")};
    return Sequence(paths);
  }();
  std::vector<Part> parts = of_files.parts();
  parts[1].begin = 7;  // whatever it was elsewhere
  const Sequence known = Sequence::of_parts(parts);
  EXPECT_EQ(known.frames(), 2000U);
  const Sequence::Place place = known.place_of(Time{13'000'000});
  EXPECT_EQ(place.part, 1U);
  EXPECT_EQ(place.offset.us, 3'000'000);
  EXPECT_EQ(to_iso(*place.utc), "2020-09-12T00:01:03.000Z");
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
  EXPECT_TRUE(support::has_line(sequence.remarks()[0], {"b.wav", "whether", "follows", "without", "not"}));
}

TEST(Sequence, TellsGapsAndOverlaps) {
  const TemporaryFolder folder;
  const Sequence sequence({ten_seconds(folder / "a_20200912_000000.wav"), ten_seconds(folder / "b_20200912_000040.wav"),
                           ten_seconds(folder / "c_20200912_000045.wav")});
  const std::vector<std::string> remarks = sequence.remarks();
  ASSERT_EQ(remarks.size(), 2U);
  EXPECT_TRUE(support::has_line(remarks[0], {"30 s", "after", "a_20200912_000000.wav"})) << remarks[0];
  EXPECT_TRUE(support::has_line(remarks[1], {"5 s", "before", "b_20200912_000040.wav"})) << remarks[1];
}

TEST(Sequence, TellsAGapOfMonthsInDays) {
  const TemporaryFolder folder;
  const Sequence sequence({ten_seconds(folder / "a_20200101_000000.wav"), ten_seconds(folder / "b_20201102_060010.wav")});
  ASSERT_EQ(sequence.remarks().size(), 1U);
  EXPECT_TRUE(support::has_line(sequence.remarks()[0], {"306.25 days", "after", "a_20200101_000000.wav"}))
      << sequence.remarks()[0];  // 306 days of a leap year from the first of January to the second of November, and a quarter
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

TEST(Sequence, LeavesOutOneOfSeveralThatCannotBeRead) {
  const TemporaryFolder folder;
  tests::write(folder / "b.wav", "torn");
  const Sequence sequence({ten_seconds(folder / "a.wav"), folder / "b.wav", ten_seconds(folder / "c.wav")});
  EXPECT_EQ(sequence.files(), 2U);
  ASSERT_EQ(sequence.unreadable().size(), 1U);
  EXPECT_NE(sequence.unreadable()[0].find("b.wav: is no sound file"), std::string::npos);
  EXPECT_FALSE(sequence.is_whole());
  EXPECT_NE(refusal_of({folder / "b.wav"}).find("is no sound file"), std::string::npos);
  EXPECT_NE(refusal_of({folder / "a.wav", folder / "nowhere.wav"}).find("nowhere.wav: no such file"), std::string::npos)
      << "a slip of the pen";
}

TEST(Sequence, TakesTheTimesThatSomebodyStates) {
  const TemporaryFolder folder;
  const Paths paths = {ten_seconds(folder / "b_210205_000010.wav"), ten_seconds(folder / "a_210205_000000.wav")};
  const Sequence sequence(paths, {.name_format = "%y%m%d_%H%M%S"});
  EXPECT_EQ(sequence.parts()[0].path, paths[1]);
  EXPECT_EQ(to_iso(*sequence.parts()[1].notes.start), "2021-02-05T00:00:10.000Z");
  const Sequence one({paths[0]}, {.begin = Time{1'000'000}});
  EXPECT_EQ(one.parts()[0].notes.start, Time{1'000'000});
  EXPECT_THROW(Sequence(paths, {.begin = Time{0}}), host::BadInput);
  EXPECT_THROW(Sequence(paths, {.name_format = "%Y%m%d_%H%M%S"}), host::BadInput);
}

/// One raw file of a HARP's table.
std::string raw_file(int minute, int second, std::uint64_t at, std::uint64_t bytes) {
  const auto byte = [](int value) { return std::string(1, static_cast<char>(value)); };
  return byte(21) + byte(2) + byte(5) + byte(3) + byte(minute) + byte(second) + tests::little_endian(250, 2) + tests::little_endian(at, 4) +
         tests::little_endian(bytes, 4) + tests::little_endian(1, 4) + tests::little_endian(100, 4) + std::string(8, '\0');
}

TEST(HarpTable, PartsAFileWhereItsRawFilesLieApart) {
  const TemporaryFolder folder;
  // The samples begin behind 12 bytes of RIFF, a table of 8 + 56 + 3 * 32, a format of 24 and 8 of their own chunk.
  const std::uint64_t begin = 12 + 8 + 56 + 96 + 24 + 8;
  const std::string head = std::string(36, '\1') + tests::little_endian(3, 2) + std::string(18, '\0');
  const std::string table = head + raw_file(0, 0, begin, 1000) + raw_file(0, 5, begin + 1000, 600) + raw_file(1, 0, begin + 1600, 400);
  std::vector<int> samples(1000, 1);
  samples[800] = 16384;
  tests::write(
      folder / "site.x.wav",
      WavBytes{.sample_rate = 100, .before_format = tests::chunk("harp", table), .samples = tests::int16_samples(samples)}.bytes());
  const Sequence sequence({folder / "site.x.wav"});
  ASSERT_EQ(sequence.parts().size(), 2U) << "the first two follow on";
  EXPECT_EQ(sequence.files(), 1U);
  EXPECT_EQ(to_iso(*sequence.parts()[0].notes.start), "2021-02-05T03:00:00.250Z");
  EXPECT_EQ(to_iso(*sequence.parts()[1].notes.start), "2021-02-05T03:01:00.250Z");
  EXPECT_FALSE(sequence.parts()[1].follows_on);
  const Sequence::Place place = sequence.place_of(Time{9'000'000});
  EXPECT_EQ(place.offset, Duration::seconds(9)) << "of the file";
  EXPECT_EQ(to_iso(*place.utc), "2021-02-05T03:01:01.250Z");
  ASSERT_EQ(sequence.remarks().size(), 1U);
  EXPECT_NE(sequence.remarks()[0].find("begins 52 s after the end of"), std::string::npos) << sequence.remarks()[0];
  SequenceReader reader(sequence, 0, 1.0);
  const std::optional<Piece> first = reader.next();
  const std::optional<Piece> second = reader.next();
  ASSERT_TRUE(first && second);
  EXPECT_EQ(first->samples.size(), 800U);
  EXPECT_EQ(second->samples[0], 0.5F);
  EXPECT_FALSE(second->follows_on);
  EXPECT_EQ(second->samples.size(), 200U);
  EXPECT_FALSE(reader.next());
  EXPECT_EQ(reader.missing_frames(), 0U);
}

TEST(HarpTable, IsNotTakenWhereItDoesNotFitTheSamples) {
  const std::string head = std::string(36, '\1') + tests::little_endian(2, 2) + std::string(18, '\0');
  const HarpSamples samples{.begin = 100, .frame_bytes = 2, .frames = 100, .channels = 1, .sample_rate = Hertz{100}};
  EXPECT_EQ(harp_runs(head + raw_file(0, 0, 100, 100) + raw_file(0, 9, 200, 100), samples).size(), 2U);
  EXPECT_TRUE(harp_runs(head + raw_file(0, 0, 102, 100) + raw_file(0, 9, 200, 100), samples).empty()) << "beside the samples";
  EXPECT_TRUE(harp_runs(head + raw_file(0, 0, 100, 100) + raw_file(0, 61, 200, 100), samples).empty()) << "no time of day";
  EXPECT_TRUE(harp_runs(head + raw_file(0, 0, 100, 100), samples).empty()) << "one entry of two";
  EXPECT_EQ(harp_rate(head + raw_file(0, 0, 100, 100) + raw_file(0, 9, 200, 100), 1), Hertz{100});
}

TEST(SoundFolder, GivesAllRecordingsInTheOrderOfTheirNames) {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder / "in" / "b");
  for (const char* name : {"in/c.WAV", "in/b/x.flac", "in/a.wav", "in/notes.txt", "in/._a.wav"}) tests::write(folder / name, "");
  EXPECT_EQ(recordings_in({folder / "in", folder / "else.txt"}),
            (Paths{folder / "in/a.wav", folder / "in/b/x.flac", folder / "in/c.WAV", folder / "else.txt"}));
  std::filesystem::create_directories(folder / "empty");
  EXPECT_THROW((void)recordings_in({folder / "empty"}), host::BadInput);
}

TEST(SoundFolder, NamesALinkThatLeadsInACircleAndTheSequenceHearsTheOthers) {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder / "in");
  const std::filesystem::path sound = ten_seconds(folder / "in" / "a_20200912_000000.wav", 8192);
  std::filesystem::create_symlink("x.wav", folder / "in" / "x.wav");
  const Paths found = recordings_in({folder / "in"});
  EXPECT_EQ(found, (Paths{sound, folder / "in" / "x.wav"}));
  const Sequence sequence(found);
  EXPECT_EQ(sequence.files(), 1U);
  ASSERT_EQ(sequence.unreadable().size(), 1U);
  EXPECT_NE(sequence.unreadable().front().find("x.wav: "), std::string::npos);
  EXPECT_FALSE(sequence.is_whole());
}

TEST(SoundFolder, NamesAFolderWithinThatCannotBeReadAndGivesTheOthers) {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder / "in" / "closed");
  tests::write(folder / "in" / "a.wav", "");
  std::filesystem::permissions(folder / "in" / "closed", std::filesystem::perms::none);
  using std::filesystem::perms;
  std::filesystem::permissions(folder / "", perms::group_all | perms::others_all, std::filesystem::perm_options::add);
  constexpr uid_t kNobody = 65534;
  const uid_t self = geteuid();
  if (self == 0) {
    ASSERT_EQ(seteuid(kNobody), 0) << "root may read every folder";
  }
  const Paths found = recordings_in({folder / "in"});
  ASSERT_EQ(seteuid(self), 0);
  EXPECT_EQ(found, (Paths{folder / "in/a.wav", folder / "in/closed"}));
  std::filesystem::permissions(folder / "in" / "closed", std::filesystem::perms::owner_all);
}

TEST(Sequence, TellsOfSamplesInASecondChunkThatAreNotListenedTo) {
  const TemporaryFolder folder;
  const std::filesystem::path sound = ten_seconds(folder / "a_20200912_000000.wav", 8192);
  EXPECT_TRUE(Sequence({sound}).is_whole());
  const Sequence before({sound});
  const auto rate = static_cast<std::size_t>(before.sample_rate().value);
  std::ofstream(sound, std::ios::binary | std::ios::app) << tests::chunk("data", std::string(3 * 2 * rate, '\1'));
  const Sequence sequence({sound});
  EXPECT_FALSE(sequence.is_whole());
  EXPECT_EQ(sequence.parts().front().frames, before.parts().front().frames);
  ASSERT_EQ(sequence.remarks().size(), 1U);
  EXPECT_TRUE(support::tells(sequence.remarks().front(), {sound.string(), "3 s", "WAV", "one", "not"}));
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
