#pragma once

#include <filesystem>
#include <string>

namespace earshot::fly {

inline constexpr const char* kSynthetic = "synthetic";
inline constexpr const char* kHearHelp =
    "the vehicle measures the SNR itself, in sound: synthetic: a tone, or a song where the environment's conditions have a pattern of "
    "calls; "
    "FILE: recorded calls (WAV, FLAC), again and again";
inline constexpr const char* kHearsAllowed = "synthetic or FILE";

/// What is wrong with a value of --hear; empty when nothing is.
[[nodiscard]] inline std::string hear_complaint(const std::string& text) {
  return text.empty() || text.front() == '-' ? "must be synthetic or name a file (one whose name begins with - as ./-...)" : "";
}

/// The file of --hear; empty for synthetic sound.
[[nodiscard]] inline std::filesystem::path recording_of(const std::string& hear) {
  return hear == kSynthetic ? std::filesystem::path() : std::filesystem::path(hear);
}

}  // namespace earshot::fly
