// Files that no recorder should have made: a clear answer each.
#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <limits>
#include <nlohmann/json.hpp>

#include "tests/sim/apps/listen/listen_program.hpp"

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
  write(folder_ / "fast.wav", WavBytes{.sample_rate = 384'000, .samples = samples}.bytes());
  expect_refused((folder_ / "fast.wav").string(), "it is sampled at 384000 Hz");
}

TEST_F(ListenProgram, ListensToWhatThereIsOfAFileThatWasCutShortAndSaysSo) {
  write(folder_ / "a.wav", WavBytes{.sample_rate = 1000, .samples = sixteen_bits(song(60, {30.0})), .told_more = 60'000}.bytes());
  EXPECT_EQ(run((folder_ / "a.wav").string()), 1);
  EXPECT_NE(errors().find("a.wav: was cut short: its header tells of 30 s more than it holds"), std::string::npos) << errors();
  EXPECT_NE(said().find("detections:  1\n"), std::string::npos) << said();
}

TEST_F(ListenProgram, RefusesWhatIsNoSoundFile) {
  write(folder_ / "text.wav", "a text that somebody called a sound\n");
  expect_refused((folder_ / "text.wav").string(), "text.wav: is no sound file that can be read");
  expect_refused((folder_ / "nowhere.wav").string(), "nowhere.wav: no such file");
  expect_refused(folder_.path().string(), "cannot be read: it is a folder");
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
