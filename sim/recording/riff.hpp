#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace earshot::recording {

/// How the samples of a WAV file lie.
struct RiffFormat {
  int coding = 0;  ///< 1: whole numbers, 3: floating point
  int channels = 0;
  int sample_rate_hz = 0;
  int bytes_per_frame = 0;
};

/// Samples of a WAV file, in bytes.
struct RiffData {
  std::uint64_t begin = 0;                ///< in the file
  std::optional<std::uint64_t> declared;  ///< by its own header; nothing: it tells no length
  std::uint64_t there = 0;                ///< that the file holds, those behind the header's size too
  std::uint64_t elsewhere = 0;            ///< in further chunks of samples
};

struct RiffChunk {
  std::string name;
  std::uint64_t begin = 0;  ///< of its content, in the file
  std::uint64_t bytes = 0;
};

/// What stands in a WAV file, but for the samples themselves.
struct RiffFile {
  std::optional<RiffFormat> format;
  RiffData data;
  std::vector<RiffChunk> chunks;  ///< the others, before and behind the samples
};

/// Nothing where the file is no WAV, RF64, BW64 or W64 file, or has no samples' chunk.
///
/// A recorder that lost its power leaves the size that it wrote last, or 0; a program that wrote into a pipe leaves the highest number; 32
/// bits wrap at 4 GiB. So what stands behind the told size counts as samples unless it is chunks up to the file's end. Source:
/// Microsoft/IBM 1991, Multimedia Programming Interface and Data Specifications 1.0; RF64: EBU Tech 3306; BW64: ITU-R BS.2088; W64: Sony
/// Wave64. Oracle: Riff.*
[[nodiscard]] std::optional<RiffFile> read_riff(const std::filesystem::path& path);

/// Its first bytes, no more than `most`.
[[nodiscard]] std::string content_of(const std::filesystem::path& path, const RiffChunk& chunk, std::uint64_t most);

}  // namespace earshot::recording
