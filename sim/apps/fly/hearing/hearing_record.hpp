#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "firmware/core/units.hpp"
#include "firmware/detector/hydrophone/estimate.hpp"
#include "firmware/messages/hydrophone_block.hpp"
#include "firmware/policy/belief/reception.hpp"
#include "sim/spectrum/short_time_spectrum.hpp"

namespace earshot::fly {

/// A spectrogram small enough for a page: whole hertz, and no more rows than a picture has points across, however long the sound. When it
/// is full its rows are joined two by two.
class SpectrogramStrip {
 public:
  static constexpr std::size_t kLowest_hz = 5;
  static constexpr std::size_t kHighest_hz = 45;
  static constexpr std::size_t kMostRows = 600;

  /// @param full_scale  of a sample of 1.0, dB re 1 uPa
  SpectrogramStrip(Hertz sample_rate, Decibels full_scale);
  void take(const messages::HydrophoneBlock& block, std::span<const float> samples);
  /// "time_s,5,6,...": the middle of each row's time, the mean density at each whole hertz, dB re 1 uPa^2/Hz.
  [[nodiscard]] std::string table() const;

 private:
  struct Row {
    std::vector<double> sum;  ///< of each hertz, shares of full scale squared per hertz
    std::uint32_t windows = 0;
  };
  void add(std::span<const float> psd, std::uint64_t begin);
  void join_rows();

  spectrum::ShortTimeSpectrum windows_;
  Decibels full_scale_;
  double row_s_ = 2.0;
  std::vector<Row> rows_;
};

/// What a flight that hears leaves of it: hearing.csv and spectrogram.csv.
class HearingRecord {
 public:
  HearingRecord(Hertz sample_rate, Decibels full_scale) : strip_(sample_rate, full_scale) {}

  /// A block that went over the bus.
  void take(const messages::HydrophoneBlock& block, std::span<const float> samples) { strip_.take(block, samples); }
  /// A measurement that the vehicle's policy may take. @param modelled  at the vehicle's place then
  void add(const detector::Estimate& measurement, const policy::Reception& modelled);

  [[nodiscard]] std::uint64_t measurements() const { return measurements_; }
  [[nodiscard]] std::uint64_t too_faint() const { return too_faint_; }
  /// Throws as host::write_whole does.
  void write(const std::filesystem::path& folder) const;

 private:
  SpectrogramStrip strip_;
  std::string rows_;
  std::uint64_t measurements_ = 0;
  std::uint64_t too_faint_ = 0;
};

}  // namespace earshot::fly
