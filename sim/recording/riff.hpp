#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

namespace earshot::recording {

/// Bytes of samples that a WAV file's own header tells of, and how many of them the file holds.
struct RiffData {
  std::uint64_t told = 0;
  std::uint64_t there = 0;
};

/// Nothing where the file is no RIFF/WAVE or RF64 file, or tells no length (a program that wrote into a pipe did not know it).
/// libsndfile reads what is there of a file that was cut short and does not say that anything is missing.
/// Source: Microsoft/IBM 1991, Multimedia Programming Interface and Data Specifications 1.0; RF64: EBU Tech 3306.
/// Oracle: Riff.*
[[nodiscard]] std::optional<RiffData> riff_data(const std::filesystem::path& path);

}  // namespace earshot::recording
