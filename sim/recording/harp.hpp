#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "firmware/core/time.hpp"
#include "firmware/core/units.hpp"

namespace earshot::recording {

/// Sound without a gap within a file, of which the recorder's clock is known.
struct ClockedRun {
  std::uint64_t first_frame = 0;
  std::uint64_t frames = 0;
  Time start;  ///< UTC
};

/// Samples of a file that has such a table.
struct HarpSamples {
  std::uint64_t begin = 0;  ///< byte of the file
  std::uint64_t frame_bytes = 2;
  std::uint64_t frames = 0;
  std::size_t channels = 1;
  Hertz sample_rate;
};

/// The runs of a HARP's .x.wav, whose chunk "harp" tells when each of its raw files begins; raw files that follow on within two
/// milliseconds are one run. Nothing where the table does not fit the samples.
/// @param table  the chunk's content
/// Source: Triton (Scripps Whale Acoustics Lab), rdxwavhd.m.   Oracle: HarpTable.*
[[nodiscard]] std::vector<ClockedRun> harp_runs(std::string_view table, const HarpSamples& samples);

/// The true sample rate, where all raw files tell the same: that of the WAV header may be a substitute.
[[nodiscard]] std::optional<Hertz> harp_rate(std::string_view table, std::size_t channels);

}  // namespace earshot::recording
