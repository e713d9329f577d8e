#include "firmware/boards/linux/hydrophone/hearing_words.hpp"

#include <gtest/gtest.h>

namespace earshot::board {
namespace {

using detector::Hearing;

Duration& of(HydrophoneProcessor::Account& account, Hearing hearing) {
  return account.sound.at(static_cast<std::size_t>(hearing));
}

TEST(HearingWords, TellWhatWasHeardAndWhatNot) {
  HydrophoneProcessor::Account account{.measurements = 112, .too_faint = 3, .detections = 2};
  of(account, Hearing::kHears) = Duration::seconds(118);
  of(account, Hearing::kFillingUp) = Duration::milliseconds(2'500);
  // 118 s and 2.5 s are 120.5 s, written without a digit behind the point, of which the even is taken.
  EXPECT_EQ(to_string(account),
            "it heard 118 s of 120 s of sound: 112 SNR measurements, 3 of them too faint to measure, and 2 detections; not heard: 2.5 s, "
            "has just "
            "begun");
}

TEST(HearingWords, SayWhatToDoAboutEachThingInTheWay) {
  HydrophoneProcessor::Account account;
  of(account, Hearing::kSelfNoise) = Duration::seconds(30);
  of(account, Hearing::kFlowNoise) = Duration::seconds(20);
  const std::string text = to_string(account);
  EXPECT_NE(text.find("it heard 0.0 s of 50 s of sound: 0 SNR measurements"), std::string::npos) << text;
  EXPECT_NE(text.find("; not heard: 20 s, flow noise (go slower, or shield the hydrophone); 30 s, the vehicle's own noise (go no faster "
                      "than self_noise_speed_mps)"),
            std::string::npos)
      << text;
}

TEST(HearingWords, TellMeasurementsThatCameFasterThanTheyWereTakenOnlyWhereSomeDid) {
  EXPECT_EQ(to_string(HydrophoneProcessor::Account{}).find("faster"), std::string::npos);
  EXPECT_NE(to_string(HydrophoneProcessor::Account{.left_out = 7}).find("and 0 detections, of which 7 came faster than they were taken"),
            std::string::npos);
}

TEST(HearingWords, TellBandAndFullScale) {
  detector::SoundSettings settings;
  settings.band = {.low = Hertz{15.0}, .high = Hertz{30.0}};
  settings.calibration = {.sensitivity = Decibels{-177.0}, .fixed_gain = Decibels{20.0}, .full_scale_volts = 10.0};
  // 20 lg 10 V = 20 dB, and 177 dB of sensitivity, less 20 dB of gain.
  EXPECT_EQ(to_string(settings), "hears 15 to 30 Hz; a sample of full scale is 177.0 dB re 1 uPa, less what gain its blocks name");
}

}  // namespace
}  // namespace earshot::board
