#pragma once

#include <filesystem>
#include <string>

#include "sim/recording/riff.hpp"

namespace earshot::recording {

/// What a file says of itself in words; empty where it does not.
struct SoundTexts {
  std::string artist{};    ///< RIFF INFO IART, Vorbis comment ARTIST
  std::string album{};     ///< IPRD
  std::string comment{};   ///< ICMT
  std::string date{};      ///< ICRD
  std::string software{};  ///< ISFT
  std::string guano{};     ///< chunk guan: lines "Key: value"
  std::string origin{};    ///< chunk bext: date and time, "2021-02-05 03:59:46"
  std::string harp{};      ///< chunk harp, as it stands: where each raw file begins
};

/// Of a WAV file's chunks.
/// Source: INFO as in riff.hpp; GUANO 1.0 (D. Riggs, guano-md.org); bext: EBU Tech 3285; harp: Triton (Scripps Whale Acoustics Lab),
/// rdxwavhd.m. Oracle: SoundFile.*, RecorderNotes.*
[[nodiscard]] SoundTexts texts_of(const std::filesystem::path& path, const RiffFile& riff);

}  // namespace earshot::recording
