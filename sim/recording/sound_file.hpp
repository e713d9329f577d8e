#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "firmware/core/units.hpp"
#include "sim/recording/harp.hpp"
#include "sim/recording/riff.hpp"
#include "sim/recording/sound_texts.hpp"

namespace earshot::recording {

/// How the samples of a file are kept.
struct SoundFormat {
  Hertz sample_rate;
  std::size_t channels = 1;
  int bits = 16;          ///< that a sample carries: 24 for floating point, whose fraction has as many
  int stored_bits = 16;   ///< of a sample in the file: 32 or 64 for floating point
  bool is_float = false;  ///< then its samples may lie beyond -1 to 1
};

/// "16 bit", "32 bit floating point"
[[nodiscard]] std::string to_string(const SoundFormat& format);

/// How what a header tells of a file's length compares with what is there.
enum class DeclaredLength : std::uint8_t {
  kRight,
  kTooLong,   ///< the file was cut short
  kTooShort,  ///< samples stand behind the told end: the recorder was killed, or 32 bits did not hold the size
  kUnknown    ///< 0 or a substitute: killed recorders leave it, and programs that write into a pipe
};

/// A sound file that is open for reading from its beginning: WAV, FLAC and what else libsndfile reads without loss (AIFF, RF64, W64, CAF).
/// It is read piece by piece: a file of any size takes the same memory. A WAV file's samples are read up to its end, whatever length its
/// header tells. Oracle: SoundFile.*
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
  /// Samples of one channel that its header announces and the file does not hold (WAV): it was cut short.
  [[nodiscard]] std::uint64_t missing_frames() const { return missing_frames_; }
  /// Samples of one channel behind the end that its header tells (WAV); frames() holds them.
  [[nodiscard]] std::uint64_t frames_behind() const { return frames_behind_; }
  /// Samples of one channel in further chunks of its own, which are not read (WAV).
  [[nodiscard]] std::uint64_t frames_elsewhere() const { return frames_elsewhere_; }
  [[nodiscard]] DeclaredLength declared_length() const { return declared_length_; }
  /// When which of its samples were taken, where the file has a table of that; else nothing.
  [[nodiscard]] const std::vector<ClockedRun>& runs() const { return runs_; }

  /// The next frame to be read. @return whether the file could go there
  [[nodiscard]] bool go_to(std::uint64_t frame);

  /// Fills `into` with whole frames, channel beside channel, shares of full scale; floating point as it stands.
  /// @param into  a multiple of the channels
  /// @return frames; fewer than there is room for at the end only
  [[nodiscard]] std::size_t read(std::span<float> into);

 private:
  void open_riff(const std::filesystem::path& path, const RiffFile& riff);
  void count_frames(const std::filesystem::path& path);

  struct Handle;
  std::unique_ptr<Handle> handle_;
  SoundFormat format_;
  SoundTexts texts_;
  std::uint64_t frames_ = 0;
  std::uint64_t missing_frames_ = 0;
  std::uint64_t frames_behind_ = 0;
  std::uint64_t frames_elsewhere_ = 0;
  DeclaredLength declared_length_ = DeclaredLength::kRight;
  std::vector<ClockedRun> runs_;
};

/// Loudest finite sample of a file, all channels together; reads it from one end to the other.
/// @param tick  called now and then; what it throws ends the reading
[[nodiscard]] double largest_magnitude(const std::filesystem::path& path, const std::function<void()>& tick);

}  // namespace earshot::recording
