#pragma once

#include <filesystem>
#include <vector>

namespace earshot::report {

/// One SNR that the vehicle measured, and what the simulator modelled there.
struct HeardRow {
  double time_s = 0.0;
  double snr_db = 0.0;
  bool too_faint = false;
  double modelled_snr_db = 0.0;
  bool modelled_too_faint = false;
};

/// A spectrogram as it lies in spectrogram.csv.
struct SpectrogramTable {
  std::vector<double> frequency_hz;
  std::vector<double> time_s;    ///< the middle of each row
  std::vector<double> level_db;  ///< re 1 uPa^2/Hz, [n_time x n_frequency]
};

/// What a flight that heard sound left of it; empty for one that was told the SNR.
struct HeardSound {
  std::vector<HeardRow> measurements;
  SpectrogramTable spectrogram;
  [[nodiscard]] bool is_there() const { return !measurements.empty() && !spectrogram.time_s.empty(); }
};

inline constexpr const char* kHearingName = "hearing.csv";
inline constexpr const char* kSpectrogramName = "spectrogram.csv";

/// @throws host::BadInput naming file and line where one is no table of its kind.
[[nodiscard]] HeardSound read_heard_sound(const std::filesystem::path& folder);

}  // namespace earshot::report
