#include "firmware/boards/cortex_m7/hearing.hpp"

namespace earshot::board {

hearing_t to_message(const detector::SoundSettings& settings, Time time) {
  return {.utime = time.us,
          .sensitivity_db = settings.calibration.sensitivity.value,
          .fixed_gain_db = settings.calibration.fixed_gain.value,
          .full_scale_volts = settings.calibration.full_scale_volts,
          .adc_bits = settings.calibration.adc_bits,
          .high_pass_corner_hz = settings.calibration.high_pass_corner.value,
          .band_low_hz = settings.band.low.value,
          .band_high_hz = settings.band.high.value,
          .integration_time_us = settings.integration_time.us,
          .floor_window_us = settings.floor_window.us,
          .noise_reference = static_cast<std::int8_t>(settings.noise_reference),
          .detection_threshold_db = settings.detection_threshold.value,
          .detections_needed = static_cast<std::int8_t>(settings.m_of_n.m),
          .detections_of = static_cast<std::int8_t>(settings.m_of_n.n),
          .longest_pause_us = settings.longest_pause.us,
          .expected_noise_db = settings.expected_noise.value,
          .gate_speed_mps = settings.gate.speed.value,
          .gate_thruster_rpm = settings.gate.thruster_rpm,
          .channels = settings.channels};
}

detector::SoundSettings to_settings(const hearing_t& message) {
  return {.calibration = {.sensitivity = Decibels{message.sensitivity_db},
                          .fixed_gain = Decibels{message.fixed_gain_db},
                          .full_scale_volts = message.full_scale_volts,
                          .adc_bits = message.adc_bits,
                          .high_pass_corner = Hertz{message.high_pass_corner_hz}},
          .band = {.low = Hertz{message.band_low_hz}, .high = Hertz{message.band_high_hz}},
          .integration_time = {message.integration_time_us},
          .floor_window = {message.floor_window_us},
          .noise_reference = message.noise_reference == 0 ? detector::NoiseReference::kPast : detector::NoiseReference::kFlanks,
          .detection_threshold = Decibels{message.detection_threshold_db},
          .m_of_n = {.m = static_cast<std::uint8_t>(message.detections_needed), .n = static_cast<std::uint8_t>(message.detections_of)},
          .longest_pause = {message.longest_pause_us},
          .expected_noise = Decibels{message.expected_noise_db},
          .gate = {.speed = MetersPerSecond{message.gate_speed_mps}, .thruster_rpm = message.gate_thruster_rpm},
          .channels = message.channels};
}

}  // namespace earshot::board
