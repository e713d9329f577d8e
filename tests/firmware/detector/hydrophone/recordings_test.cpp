// Real whales, heard where the recordings are (tests/support/reference_folder.hpp). Without them the tests are skipped.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "tests/firmware/detector/hydrophone/hearer.hpp"
#include "tests/support/reference_folder.hpp"

namespace earshot::detector {
namespace {

std::filesystem::path folder() {
  return support::reference_folder() / "recordings";
}

struct Recording {
  double rate = 0.0;
  std::vector<float> samples;  ///< within +-1
};

/// A WAV file of one channel, 16 bits or float: all that is needed here.
Recording read(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  const std::vector<char> bytes{std::istreambuf_iterator<char>(stream), {}};
  const auto number = [&bytes](std::size_t at, auto value) {
    std::memcpy(&value, bytes.data() + at, sizeof value);
    return value;
  };
  Recording recording;
  std::uint16_t bits = 0;
  for (std::size_t at = 12; at + 8 <= bytes.size();) {
    const std::size_t size = std::min<std::size_t>(number(at + 4, std::uint32_t{}), bytes.size() - at - 8);
    const std::string_view name(bytes.data() + at, 4);
    if (name == "fmt ") recording.rate = number(at + 12, std::uint32_t{});
    if (name == "fmt ") bits = number(at + 22, std::uint16_t{});
    for (std::size_t i = at + 8; name == "data" && i + bits / 8U <= at + 8 + size; i += bits / 8U)
      recording.samples.push_back(bits == 16 ? static_cast<float>(number(i, std::int16_t{})) / 32'768.0F : number(i, float{}));
    at += 8 + size + size % 2;
  }
  float most = 0.0F;
  for (const float x : recording.samples) most = std::max(most, std::abs(x));
  if (most >= 1.0F && bits == 32) {
    for (float& x : recording.samples) x /= 2.0F * most;
  }
  return recording;
}

/// As at a desk: the beginning twice, at a threshold of 6 dB.
std::vector<Detection> detections_of(const std::string& name, SoundSettings settings) {
  const Recording recording = read(folder() / name);
  settings.detection_threshold = Decibels{6};
  settings.band = audible_part(settings.band, Hertz{recording.rate});
  Hearer hearer(settings, recording.rate);
  EXPECT_EQ(hearer.status, Status::kOk);
  hearer.hear_twice(recording.samples, recording.rate, settings);
  return hearer.detections;
}

class Recordings : public ::testing::Test {
 protected:
  void SetUp() override {
    if (std::filesystem::exists(folder())) return;
    if (support::is_reference_required()) FAIL() << "no recordings in " << folder();
    GTEST_SKIP() << "no recordings in " << folder();
  }
};

double seconds_of(Time time) {
  return 1e-6 * static_cast<double>(time.us);
}

TEST_F(Recordings, AFinWhalesSongIsHeardPulseByPulse) {
  std::ifstream list(folder() / "fin_whale_song_450s.events.csv");
  std::vector<double> events;
  std::string line;
  for (std::getline(list, line); std::getline(list, line);) events.push_back(std::stod(line));
  ASSERT_EQ(events.size(), 47U);
  const std::vector<Detection> detections = detections_of("fin_whale_song_450s.wav", fin_whale());
  const auto is_near = [](double event) { return [event](const Detection& d) { return std::abs(seconds_of(d.begin) - event) <= 2.0; }; };
  const auto found = std::ranges::count_if(events, [&](double event) { return std::ranges::any_of(detections, is_near(event)); });
  const auto others = std::ranges::count_if(
      detections, [&](const Detection& d) { return std::ranges::none_of(events, [&](double event) { return is_near(event)(d); }); });
  EXPECT_GE(found, 43);  // measured 43 of 47; the bar is 90 %
  EXPECT_LE(others, 5);  // measured none
}

TEST_F(Recordings, ABlueWhalesWeakCallsAreHeardOnceEach) {
  for (const SoundSettings& settings : {fin_whale(), blue_whale()}) {
    const std::vector<Detection> detections = detections_of("blue_whale_b_calls_weak_50hz.wav", settings);
    EXPECT_GE(detections.size(), 4U);
    EXPECT_LE(detections.size(), 6U);
  }
}

TEST_F(Recordings, ADownSweepIsHeardOnce) {
  EXPECT_EQ(detections_of("fin_low_frequency_downsweep.wav", fin_whale()).size(), 1U);
}

}  // namespace
}  // namespace earshot::detector
