#include "sim/hydrophone/recorded_calls.hpp"

#include <gtest/gtest.h>
#include <sndfile.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "firmware/host/file/bad_input.hpp"
#include "tests/support/temporary_folder.hpp"

namespace earshot::hydrophone {
namespace {

class RecordedCalls : public testing::Test {
 protected:
  /// A mono WAV file of 32-bit floats. @param at  sample at a time in seconds
  [[nodiscard]] std::filesystem::path file_of(int rate_hz, double seconds, const std::function<double(double)>& at) const {
    const std::filesystem::path path = folder_ / "calls.wav";
    SF_INFO info{
        .frames = 0, .samplerate = rate_hz, .channels = 1, .format = SF_FORMAT_WAV | SF_FORMAT_FLOAT, .sections = 0, .seekable = 0};
    SNDFILE* file = sf_open(path.c_str(), SFM_WRITE, &info);
    std::vector<float> samples(static_cast<std::size_t>(std::llround(seconds * rate_hz)));
    for (std::size_t i = 0; i < samples.size(); ++i) samples[i] = static_cast<float>(at(static_cast<double>(i) / rate_hz));
    EXPECT_EQ(sf_writef_float(file, samples.data(), static_cast<sf_count_t>(samples.size())), static_cast<sf_count_t>(samples.size()));
    sf_close(file);
    return path;
  }

  [[nodiscard]] static std::string complaint(const std::filesystem::path& file) {
    try {
      (void)load_calls(file, detector::fin_whale());
    } catch (const host::BadInput& e) {
      return e.what();
    }
    return "";
  }

  const support::TemporaryFolder folder_;
};

double tone(double time_s, double frequency_hz) {
  return std::sin(2.0 * std::numbers::pi * frequency_hz * time_s);
}

/// Root mean square of a second.
double level_from(const Recording& recording, double begin_s) {
  double squares = 0.0;
  for (int i = 0; i < 1000; ++i) squares += std::pow(recording.at(begin_s + i / 1000.0), 2.0);
  return std::sqrt(squares / 1000.0);
}

TEST_F(RecordedCalls, HaveARootMeanSquareOfOneOverTheirLoudestSecond) {
  for (const int rate_hz : {250, 1000, 48'000}) {
    // Ten seconds of a tone, a tenth as loud but for the third to the sixth second, so faint in the file as a quiet recording is.
    const auto calls = load_calls(file_of(rate_hz, 10.0, [](double t) { return (t >= 3.0 && t < 6.0 ? 0.01 : 0.001) * tone(t, 20.0); }),
                                  detector::fin_whale());
    // The band-pass rings for a fraction of a second about each change: 0.1 dB.
    EXPECT_NEAR(level_from(calls, 4.0), 1.0, 0.012) << rate_hz;
    EXPECT_NEAR(level_from(calls, 8.0), 0.1, 0.0012) << rate_hz;
    EXPECT_NEAR(level_from(calls, 14.0), 1.0, 0.012) << "heard again and again";
  }
}

TEST_F(RecordedCalls, LeaveOutWhatTheDetectorDoesNotListenTo) {
  const auto calls =
      load_calls(file_of(8000, 10.0, [](double t) { return 0.01 * tone(t, 20.0) + 0.9 * tone(t, 1000.0); }), detector::fin_whale());
  // A kilohertz is 80 dB down but where the recording begins anew, which the loudest second there has 0.1 dB of; and as above.
  EXPECT_NEAR(level_from(calls, 5.0), 1.0, 0.024);
}

TEST_F(RecordedCalls, AreRefusedWithTheFileNamedWhereNothingOfThemCouldBeHeard) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(complaint(file_of(1000, 10.0, [](double) { return 0.0; })).find("calls.wav: is silent"), std::string::npos);
  EXPECT_NE(complaint(file_of(1000, 10.0, [](double) { return 0.25; })).find("calls.wav: is silent"), std::string::npos) << "a voltage";
  EXPECT_NE(complaint(file_of(1000, 10.0, [](double t) { return tone(t, 0.05) * tone(t, 200.0); })).find("holds no sound from 15 to 30 Hz"),
            std::string::npos)
      << "it swells and dies away, so that no frequency is in it but its own";
  EXPECT_NE(complaint(file_of(1000, 10.0, [nan](double t) { return t > 2.0 ? nan : tone(t, 20.0); })).find("is no finite number"),
            std::string::npos);
  EXPECT_NE(complaint(file_of(1000, 0.001, [](double) { return 0.5; })).find("holds 0.001 s of sound"), std::string::npos);
  EXPECT_NE(complaint(file_of(1, 60.0, [](double t) { return t / 100.0; })).find("is sampled at 1 Hz"), std::string::npos);
  EXPECT_NE(complaint(folder_ / "nothing.wav").find("nothing.wav"), std::string::npos);
}

}  // namespace
}  // namespace earshot::hydrophone
