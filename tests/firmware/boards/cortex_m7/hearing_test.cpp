#include "firmware/boards/cortex_m7/hearing.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace earshot::board {
namespace {

std::vector<std::uint8_t> bytes_of(const hearing_t& message) {
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(message.getEncodedSize()));
  message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  return bytes;
}

// No two of its numbers are alike, so that none can stand in another's place.
TEST(HearingMessage, ComesBackWithEveryNumberInItsPlace) {
  const hearing_t message{.utime = 0,
                          .sensitivity_db = -181,
                          .fixed_gain_db = 2,
                          .full_scale_volts = 3,
                          .adc_bits = 14,
                          .high_pass_corner_hz = 5,
                          .band_low_hz = 16,
                          .band_high_hz = 27,
                          .integration_time_us = 8'000'000,
                          .floor_window_us = 90'000'000,
                          .noise_reference = 1,
                          .detection_threshold_db = 10.5,
                          .detections_needed = 3,
                          .detections_of = 4,
                          .longest_pause_us = 1'200'000,
                          .expected_noise_db = 93,
                          .gate_speed_mps = 1.5,
                          .gate_thruster_rpm = 600,
                          .channels = 0x81};
  EXPECT_EQ(bytes_of(to_message(to_settings(message), Time{})), bytes_of(message));
}

TEST(HearingMessage, SaysAFinWhalesBandInHertzAndMicroseconds) {
  const hearing_t message = to_message(detector::fin_whale(), Time{7});
  EXPECT_EQ(message.utime, 7);
  EXPECT_EQ(message.band_low_hz, 15.0);
  EXPECT_EQ(message.band_high_hz, 30.0);
  EXPECT_EQ(message.integration_time_us, 1'000'000);
  EXPECT_EQ(message.noise_reference, 0);
}

}  // namespace
}  // namespace earshot::board
