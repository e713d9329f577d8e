// Files that no recorder should have made: a clear answer each.
#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <limits>
#include <nlohmann/json.hpp>

#include "tests/sim/apps/listen/listen_program.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot::tests {
namespace {

TEST_F(ListenProgram, SaysThatZerosAreNoSound) {
  expect_refused(wav("zeros.wav", std::vector<float>(60'000, 0.0F)), "zeros.wav: cannot be listened to: every sample alike");
}

TEST_F(ListenProgram, SaysThatOneSampleIsTooShort) {
  expect_refused(wav("one.wav", {0.5F}), "one.wav: cannot be listened to: 0.001 s of sound are too short");
}

TEST_F(ListenProgram, SaysThatNansAreNoNumbers) {
  const std::vector<float> samples(60'000, std::numeric_limits<float>::quiet_NaN());
  write(folder_ / "a.wav", WavBytes{.sample_rate = 1000, .bits = 32, .format = 3, .samples = float_samples(samples)}.bytes());
  expect_refused((folder_ / "a.wav").string(), "cannot be listened to: samples that are no numbers");
}

TEST_F(ListenProgram, HearsARecordingOf24BitsAndEightChannels) {
  const std::vector<float> samples = song(60, {30.0});
  std::string bytes;
  for (const float sample : samples) {  // silence but for the third channel
    const auto value = static_cast<std::uint32_t>(std::lround(8'388'607.0F * sample));
    bytes += std::string(6, '\0') + little_endian(value & 0xFFFFFFU, 3) + std::string(15, '\0');
  }
  write(folder_ / "a.wav", WavBytes{.sample_rate = 1000, .channels = 8, .bits = 24, .samples = bytes}.bytes());
  ASSERT_EQ(run((folder_ / "a.wav").string() + " --channel 3"), 0) << errors();
  EXPECT_NE(said().find("channel 3 of 8"), std::string::npos);
  EXPECT_NE(said().find("detections:  1\n"), std::string::npos) << said();
  expect_refused((folder_ / "a.wav").string(), "every sample alike");
  expect_refused((folder_ / "a.wav").string() + " --channel 9", "--channel = 9: ");
}

TEST_F(ListenProgram, SaysThatARateIsTooLowOrTooHighForTheBand) {
  const std::string samples = sixteen_bits(song(20, {}));
  write(folder_ / "slow.wav", WavBytes{.sample_rate = 1, .samples = samples}.bytes());
  expect_refused((folder_ / "slow.wav").string(), "it is sampled at 1 Hz, too slowly for the band of 15 to 30 Hz");
  write(folder_ / "fast.wav", WavBytes{.sample_rate = 2'000'000, .samples = samples}.bytes());
  expect_refused((folder_ / "fast.wav").string(), "it is sampled at 2000000 Hz, and no more than 1000000 Hz are taken");
}

TEST_F(ListenProgram, ListensToWhatThereIsOfAFileThatWasCutShortAndSaysSo) {
  write(folder_ / "a.wav", WavBytes{.sample_rate = 1000, .samples = sixteen_bits(song(60, {30.0})), .declares_more = 60'000}.bytes());
  EXPECT_EQ(run((folder_ / "a.wav").string()), 1);
  EXPECT_TRUE(support::has_line(errors(), {"a.wav", "cut short", "30 s"})) << errors();
  EXPECT_NE(said().find("detections:  1\n"), std::string::npos) << said();
}

TEST_F(ListenProgram, HearsWhatStandsBehindTheEndThatTheHeaderTellsAndSaysSo) {
  std::string bytes = WavBytes{.sample_rate = 1000, .samples = sixteen_bits(song(60, {12.0, 50.0}))}.bytes();
  for (const auto& [told, mentioned] : {std::pair{60'000ULL, "holds 30 s of samples behind the end that its header gives"},
                                        {0ULL, "its header does not give its length"},
                                        {0xFFFFFFFFULL, "its header does not give its length"}}) {
    bytes.replace(40, 4, little_endian(told, 4));
    write(folder_ / "a.wav", bytes);
    EXPECT_EQ(run((folder_ / "a.wav").string()), 1);
    EXPECT_NE(errors().find(mentioned), std::string::npos) << errors();
    EXPECT_NE(said().find("detections:  2\n"), std::string::npos) << said();
    EXPECT_NE(said().find(": 60 s at 1000 Hz"), std::string::npos) << said();
  }
}

TEST_F(ListenProgram, HearsTheOtherFilesWhereOneCannotBeReadAndTakesFolders) {
  std::filesystem::create_directories(folder_ / "in");
  wav("in/a_20200912_000000.wav", song(60, {12.0}));
  wav("in/c_20200912_000100.wav", song(60, {20.0}));
  write(folder_ / "in/b.wav", "torn");
  EXPECT_EQ(run((folder_ / "in").string() + " --csv " + out("a.csv")), 1);
  EXPECT_TRUE(support::has_line(errors(), {"in/b.wav", "no sound", "file"})) << errors();
  EXPECT_NE(said().find("a_20200912_000000.wav and 1 more files: 120 s"), std::string::npos) << said();
  EXPECT_NE(said().find("detections:  2\n"), std::string::npos) << said();
  EXPECT_EQ(run((folder_ / "in").string() + " --force --csv " + (folder_ / "in/a_20200912_000000.wav").string()), 2)
      << "a recording in a folder is not replaced either";
}

TEST_F(ListenProgram, SaysThatNoBeginIsKnownAndTakesOneThatIsStated) {
  const std::string song_file = wav("SITE_210205_035946.wav", song(20, {}));
  ASSERT_EQ(run(song_file), 0) << errors();
  EXPECT_NE(said().find("begins:      not known"), std::string::npos) << said();
  ASSERT_EQ(run(song_file + " --begin 2021-02-05T03:59:46+10:00"), 0) << errors();
  EXPECT_NE(said().find("begins:      2021-02-04T17:59:46.000Z, from --begin"), std::string::npos) << said();
  ASSERT_EQ(run(song_file + " --time-format %y%m%d_%H%M%S"), 0) << errors();
  EXPECT_TRUE(support::has_line(said(), {"begins", "2021-02-05T03:59:46.000Z", "--time-format"})) << said();
  expect_refused(song_file + " --begin yesterday", "yesterday: is no time such as");
  expect_refused(song_file + " --time-format %H%M%S", "must have the year");
  expect_refused(song_file + " --time-format %Y%m%d_%H", "its name has no time as --time-format has it");
}

TEST_F(ListenProgram, HearsWhatARecorderOf384KilohertzTakes) {
  // 30 s, with a cry of an eighth of full scale at 96 kHz less 20 Hz, which would fold onto a call's 20 Hz were it only sampled anew.
  const std::vector<float> slow = song(30, {20.0}, 0.05);
  std::vector<float> fast(slow.size() * 384);
  for (std::size_t i = 0; i < fast.size(); ++i) {
    const double at = static_cast<double>(i) / 384.0;
    const auto before = static_cast<std::size_t>(at);
    const float share = static_cast<float>(at - static_cast<double>(before));
    fast[i] = (1.0F - share) * slow[before] + share * slow[std::min(before + 1, slow.size() - 1)];
    const bool is_cry = i >= 10 * 384'000 && i < 11 * 384'000;
    if (is_cry) fast[i] += static_cast<float>(0.125 * std::sin(2.0 * std::numbers::pi * 95'980.0 * static_cast<double>(i) / 384'000.0));
  }
  write(folder_ / "a.wav", WavBytes{.sample_rate = 384'000, .samples = sixteen_bits(fast)}.bytes());
  ASSERT_EQ(run((folder_ / "a.wav").string() + " --csv " + out("a.csv")), 0) << errors();
  const auto rows = rows_of(content_of(out("a.csv")), ',');
  ASSERT_EQ(rows.size(), 2U) << said();
  EXPECT_NEAR(std::stod(rows[1][0]), 20.0, 0.3);
  EXPECT_NEAR(std::stod(rows[1][5]), -29.03, 0.6) << "10 lg(7/8): the window may miss an eighth of the call";
}

TEST_F(ListenProgram, RefusesWhatIsNoSoundFile) {
  write(folder_ / "text.wav", "a text that somebody called a sound\n");
  expect_refused((folder_ / "text.wav").string(), "text.wav: is no sound file that can be read");
  expect_refused((folder_ / "nowhere.wav").string(), "nowhere.wav: no such file");
  expect_refused((folder_ / "out").string(), "out: is a folder without a recording");
  ASSERT_EQ(mkfifo((folder_ / "pipe.wav").c_str(), 0600), 0);
  expect_refused((folder_ / "pipe.wav").string(), "cannot be read: it is a pipe");
}

TEST_F(ListenProgram, RefusesFourGigabytesOfNothingAtOnce) {
  write(folder_ / "a.wav", "");
  std::filesystem::resize_file(folder_ / "a.wav", std::uintmax_t{4} << 30U);
  expect_refused((folder_ / "a.wav").string(), "is no sound file that can be read");
}

TEST_F(ListenProgram, KnowsTheNoiseOfARecordingThatIsClippedFromEndToEnd) {
  std::vector<float> samples = song(60, {});
  for (std::size_t i = 0; i < samples.size(); i += 100) samples[i] = 1.0F;
  ASSERT_EQ(run(wav("a.wav", samples) + " --json " + out("a.json")), 0) << errors();
  const auto json = nlohmann::json::parse(content_of(out("a.json")));
  EXPECT_EQ(json["not_heard_s"].count("clipped"), 1U) << json.dump(2);
  EXPECT_TRUE(json["noise_db"].is_number()) << "it is told as clipped sound is";
}

TEST_F(ListenProgram, ListensNoLongerThanTheSoundIs) {
  // At 2 kHz an estimate comes every 0.248 s, not every quarter of a second.
  write(folder_ / "a.wav", WavBytes{.sample_rate = 2000, .samples = sixteen_bits(song(240, {}))}.bytes());
  ASSERT_EQ(run((folder_ / "a.wav").string() + " --json " + out("a.json")), 0) << errors();
  const auto json = nlohmann::json::parse(content_of(out("a.json")));
  EXPECT_EQ(json["duration_s"], 120.0);
  EXPECT_LE(json["listened_s"].get<double>() + json["not_heard_s"].value("has just begun", 0.0), 120.0);
}

TEST_F(ListenProgram, SaysThatTheFiltersBeginAnewAfterAPauseAndMissesNoSampleOfTheLength) {
  const std::string files = wav("a_20200912_000000.wav", song(121, {})) + " " + wav("a_20200912_001000.wav", song(120, {}));
  ASSERT_EQ(run(files + " --json " + out("a.json")), 0) << errors();
  EXPECT_TRUE(support::has_line(said(), {"heard", "filters", "anew", "2.7 s"})) << said();
  EXPECT_EQ(said().find("samples are missing"), std::string::npos) << said();
  const auto json = nlohmann::json::parse(content_of(out("a.json")));
  ASSERT_EQ(json["not_heard_s"].size(), 1U) << json.dump(2);
  EXPECT_NEAR(json["listened_s"].get<double>() + json["not_heard_s"]["the filters begin anew where sound does not go on"].get<double>(),
              241.0, 1e-6);
}

TEST_F(ListenProgram, GivesNoScoreWhereNoSelectionIsOfWhatItListensTo) {
  const std::string recording = wav("a.wav", song(60, {20.0}));
  const std::string table = (folder_ / "channel2.txt").string();
  std::ofstream(table) << "Channel\tBegin Time (s)\tEnd Time (s)\n2\t20\t21\n2\t30\t31\n";
  expect_refused(recording + " --score " + table,
                 "channel2.txt: no score: none of its selections is of what is listened to: 2 are of other channels than 1, 0 of");
}

TEST_F(ListenProgram, TellsACallThatIsClipped) {
  // Beyond full scale for a tenth of each period: arccos(1 / 1.05) / (pi / 2) = 0.20 of the samples lie there.
  ASSERT_EQ(run(wav("a.wav", song(60, {12.0, 30.0}, 1.05)) + " --csv " + out("a.csv")), 0) << errors();
  const auto rows = rows_of(content_of(out("a.csv")), ',');
  ASSERT_EQ(rows.size(), 3U) << said();
  EXPECT_EQ(rows[1].back(), "clipped");
  EXPECT_EQ(said().find("nan"), std::string::npos) << said();
  EXPECT_NEAR(std::stod(rows[2][0]), 30.0, 1.0);
}

}  // namespace
}  // namespace earshot::tests
