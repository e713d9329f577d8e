#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "firmware/core/units.hpp"
#include "sim/spectrum/spectrogram.hpp"

namespace earshot::plot {

/// A part of a spectrogram that is pointed out.
struct Mark {
  double begin_s = 0.0;
  double end_s = 0.0;
  Hertz low;
  Hertz high;
};

struct SpectrogramCaption {
  std::string title;
  std::string subtitle;
  std::string level;   ///< of the colours, "dB re 1 µPa²/Hz"
  Hertz colours_from;  ///< what lies lower, often the sea's own rumble, does not count for the range of colours
};

/// Draws levels against time and frequency, with a bar above and below each mark, as PNG or SVG by the path's extension. The colours go
/// from the level that a tenth lies under to the loudest but a thousandth, so that neither silence nor one knock takes them all.
/// @param correction  added to all levels
/// Throws as draw() does.
void plot_spectrogram(const std::filesystem::path& path, const spectrum::Spectrogram& spectrogram, Decibels correction,
                      const std::vector<Mark>& marks, const SpectrogramCaption& caption);

}  // namespace earshot::plot
