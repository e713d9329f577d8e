#include "sim/apps/fly/hearing/hearing_record.hpp"

#include <cmath>

#include "firmware/host/file/output_file.hpp"
#include "firmware/host/text/numbers.hpp"

namespace earshot::fly {
namespace {

constexpr std::size_t kColumns = SpectrogramStrip::kHighest_hz - SpectrogramStrip::kLowest_hz + 1;

}  // namespace

SpectrogramStrip::SpectrogramStrip(Hertz sample_rate, Decibels full_scale) : windows_(sample_rate, 2), full_scale_(full_scale) {}

void SpectrogramStrip::take(const messages::HydrophoneBlock& block, std::span<const float> samples) {
  windows_.take(samples, static_cast<std::uint64_t>(block.first_sample),
                [this](std::span<const float> psd, std::uint64_t begin) { add(psd, begin); });
}

void SpectrogramStrip::add(std::span<const float> psd, std::uint64_t begin) {
  const double time_s = static_cast<double>(begin) / windows_.sample_rate().value;
  while (time_s >= row_s_ * static_cast<double>(kMostRows)) join_rows();
  const auto at = static_cast<std::size_t>(time_s / row_s_);
  if (at >= rows_.size()) rows_.resize(at + 1, Row{.sum = std::vector<double>(kColumns, 0.0)});
  Row& row = rows_[at];
  for (std::size_t i = 0; i < kColumns; ++i) {
    const double bin = static_cast<double>(kLowest_hz + i) / windows_.bin_width().value;
    row.sum[i] += static_cast<double>(psd[static_cast<std::size_t>(std::lround(bin))]);
  }
  ++row.windows;
}

void SpectrogramStrip::join_rows() {
  row_s_ *= 2.0;
  for (std::size_t i = 0; 2 * i < rows_.size(); ++i) {
    Row joined = rows_[2 * i];
    if (2 * i + 1 < rows_.size()) {
      const Row& next = rows_[2 * i + 1];
      for (std::size_t k = 0; k < kColumns; ++k) joined.sum[k] += next.sum[k];
      joined.windows += next.windows;
    }
    rows_[i] = joined;
  }
  rows_.resize((rows_.size() + 1) / 2);
}

std::string SpectrogramStrip::table() const {
  std::string text = "time_s";
  for (std::size_t hz = kLowest_hz; hz <= kHighest_hz; ++hz) text += host::formatted(",%zu", hz);
  text += "\n";
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const Row& row = rows_[i];
    if (row.windows == 0) continue;
    text += host::formatted("%.1f", (static_cast<double>(i) + 0.5) * row_s_);
    for (const double sum : row.sum)
      text += host::formatted(",%.1f", 10.0 * std::log10(std::max(sum / row.windows, 1e-30)) + full_scale_.value);
    text += "\n";
  }
  return text;
}

void HearingRecord::add(const detector::Estimate& measurement, const policy::Reception& modelled) {
  ++measurements_;
  too_faint_ += measurement.too_faint ? 1U : 0U;
  rows_ += host::formatted("%.6f,%.4f,%d,%.4f,%d,%.3f,%.3f\n", (measurement.time - Time{}).to_seconds(), measurement.snr.value,
                           measurement.too_faint ? 1 : 0, modelled.snr.value, modelled.too_faint ? 1 : 0, measurement.level.value,
                           measurement.floor.value);
}

void HearingRecord::write(const std::filesystem::path& folder) const {
  host::write_whole(folder / "hearing.csv",
                    "time_s,snr_db,too_faint,modelled_snr_db,modelled_too_faint,level_db_re_1upa,noise_db_re_1upa\n" + rows_);
  host::write_whole(folder / "spectrogram.csv", strip_.table());
}

}  // namespace earshot::fly
