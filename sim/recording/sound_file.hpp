#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>

#include "firmware/core/units.hpp"

namespace earshot::recording {

/// How the samples of a file are kept.
struct SoundFormat {
  Hertz sample_rate;
  std::size_t channels = 1;
  int bits = 16;          ///< that a sample carries: 24 for floating point, whose fraction has as many
  bool is_float = false;  ///< then its samples may lie beyond -1 to 1
};

/// What a file says of itself in words; empty where it does not.
struct SoundTexts {
  std::string artist;    ///< RIFF INFO IART, Vorbis comment ARTIST
  std::string album;     ///< IPRD
  std::string comment;   ///< ICMT
  std::string date;      ///< ICRD
  std::string software;  ///< ISFT
};

/// A sound file that is open for reading from its beginning: WAV, FLAC and what else libsndfile reads without loss (AIFF, RF64, W64, CAF).
/// It is read piece by piece: a file of any size takes the same memory.
/// Oracle: SoundFile.*
class SoundFile {
 public:
  /// A file that does not say how long it is (FLAC out of a pipe) is read to its end once.
  /// Throws host::BadInput naming the file where it is none, holds no sample, or is coded with loss.
  explicit SoundFile(const std::filesystem::path& path);
  ~SoundFile();
  SoundFile(const SoundFile&) = delete;
  SoundFile& operator=(const SoundFile&) = delete;

  [[nodiscard]] const SoundFormat& format() const { return format_; }
  [[nodiscard]] const SoundTexts& texts() const { return texts_; }
  /// Samples of one channel that it holds; of a FLAC file that was cut short: should hold.
  [[nodiscard]] std::uint64_t frames() const { return frames_; }
  /// Samples of one channel that its header tells of and the file does not hold (WAV): it was cut short.
  [[nodiscard]] std::uint64_t missing_frames() const { return missing_frames_; }

  /// Fills `into` with whole frames, channel beside channel, shares of full scale; floating point as it stands.
  /// @param into  a multiple of the channels
  /// @return frames; fewer than there is room for at the end only
  [[nodiscard]] std::size_t read(std::span<float> into);

 private:
  struct Handle;
  std::unique_ptr<Handle> handle_;
  SoundFormat format_;
  SoundTexts texts_;
  std::uint64_t frames_ = 0;
  std::uint64_t missing_frames_ = 0;
};

/// Loudest finite sample of a file, all channels together; reads it from one end to the other.
[[nodiscard]] double largest_magnitude(const std::filesystem::path& path);

}  // namespace earshot::recording
