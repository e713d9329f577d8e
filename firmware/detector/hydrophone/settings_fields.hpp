#pragma once

#include "firmware/detector/hydrophone/settings.hpp"
#include "firmware/messages/dictionary/message.hpp"

namespace earshot::messages {

template <>
struct Described<detector::SoundSettings> {
  using Settings = detector::SoundSettings;
  using Calibration = detector::Calibration;
  static constexpr std::string_view kType = "hearing_t";
  static constexpr std::string_view kChannel = "EARSHOT_HEARING";
  static constexpr std::string_view kMeaning = "What a microcontroller listens for in its hydrophone's samples. On its serial line alone.";
  static constexpr LineList kFields{
      sent_time("utime"),
      field<&Settings::calibration, &Calibration::sensitivity>("sensitivity_db", {.meaning = "of the hydrophone, dB re 1 V/uPa"}),
      field<&Settings::calibration, &Calibration::fixed_gain>("fixed_gain_db"),
      field<&Settings::calibration, &Calibration::full_scale_volts>("full_scale_volts", {.meaning = "at the ADC's input"}),
      field<&Settings::calibration, &Calibration::adc_bits>("adc_bits"),
      field<&Settings::calibration, &Calibration::high_pass_corner>("high_pass_corner_hz", {.meaning = "0: none"}),
      field<&Settings::band, &detector::Band::low>("band_low_hz"),
      field<&Settings::band, &detector::Band::high>("band_high_hz"),
      field<&Settings::integration_time>("integration_time_us"),
      field<&Settings::floor_window>("floor_window_us"),
      field<&Settings::noise_reference>("noise_reference", {.meaning = "NoiseReference of firmware/detector/hydrophone/settings.hpp"}),
      field<&Settings::detection_threshold>("detection_threshold_db"),
      field<&Settings::m_of_n, &detector::MOfN::m>("detections_needed", {.meaning = "of so many estimates:"}),
      field<&Settings::m_of_n, &detector::MOfN::n>("detections_of"),
      field<&Settings::longest_pause>("longest_pause_us"),
      field<&Settings::expected_noise>("expected_noise_db", {.meaning = "dB re 1 uPa; NaN: not known"}),
      field<&Settings::gate, &detector::SelfNoiseGate::speed>("gate_speed_mps", {.meaning = "above it the vehicle hears itself"}),
      field<&Settings::gate, &detector::SelfNoiseGate::thruster_rpm>("gate_thruster_rpm"),
      byte_field<&Settings::channels>("channels", {.meaning = "one bit for each"}),
  };
};

static_assert(covers_all_members<detector::SoundSettings>());

}  // namespace earshot::messages
