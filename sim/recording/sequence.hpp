#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "firmware/core/time.hpp"
#include "firmware/core/units.hpp"
#include "sim/recording/recorder.hpp"
#include "sim/recording/sound_file.hpp"

namespace earshot::recording {

/// A file of a sequence, or the part of one that its recorder took without a gap.
struct Part {
  std::filesystem::path path;
  SoundFormat format;
  RecorderNotes notes;                 ///< the start is that of this part
  std::uint64_t file_frames = 0;       ///< of the file as a whole
  std::uint64_t first_frame = 0;       ///< in the file
  std::uint64_t frames = 0;            ///< of this part
  std::uint64_t missing_frames = 0;    ///< that the header tells of, behind this part
  std::uint64_t frames_behind = 0;     ///< of these that the header does not tell of
  std::uint64_t frames_elsewhere = 0;  ///< of the file, in further chunks of samples, which are not listened to
  DeclaredLength declared_length = DeclaredLength::kRight;
  std::uint64_t begin = 0;  ///< frames of the sequence before it
  bool follows_on = false;  ///< the part before ends where this one begins, as the recorder's clock has it
};

/// What somebody says of when files begin, in place of what they say themselves.
struct StatedTimes {
  std::optional<Time> begin{};  ///< of the only file
  std::string name_format{};    ///< of the files' names, see time_by_format()
};

/// Files of one recorder, one after the other. Time runs from the start of the sequence through the sound that there is, as Raven counts
/// it: a pause between two files takes none. Where every file tells when it began they are put in that order, else they stay as they were
/// given. Oracle: Sequence.*
class Sequence {
 public:
  /// How far the end of a file and the beginning of the next may lie apart for sound without a gap: recorders tell whole seconds.
  static constexpr Duration kClockStep = Duration::seconds(1);

  /// Looks into every file. One of several that is there and cannot be read is left out: see unreadable(). Throws host::BadInput where none
  /// can be read, and where one is not there, is named twice, has no time as `stated` has it, or differs from the first in sample rate or
  /// channels.
  explicit Sequence(const std::vector<std::filesystem::path>& paths, const StatedTimes& stated = {});
  /// Of parts that are known already, in their order: of files that were looked into before, or of samples that are in no file. None is
  /// read; their begins are reckoned anew. @param parts  at least one
  [[nodiscard]] static Sequence of_parts(std::vector<Part> parts);

  [[nodiscard]] const std::vector<Part>& parts() const { return parts_; }
  /// How many files the parts are of.
  [[nodiscard]] std::size_t files() const { return files_; }
  /// Why files were left out: "FILE: reason".
  [[nodiscard]] const std::vector<std::string>& unreadable() const { return unreadable_; }
  /// Whether all that the recorder took is here, as far as the headers tell.
  [[nodiscard]] bool is_whole() const;
  [[nodiscard]] Hertz sample_rate() const { return parts_.front().format.sample_rate; }
  [[nodiscard]] std::size_t channels() const { return parts_.front().format.channels; }
  [[nodiscard]] std::uint64_t frames() const { return parts_.back().begin + parts_.back().frames; }
  [[nodiscard]] Duration duration() const { return time_of(frames()) - Time{}; }
  /// Of a frame, from the start of the sequence.
  [[nodiscard]] Time time_of(std::uint64_t frame) const;

  /// Where an instant of the sequence lies; what is before its start lies at it.
  struct Place {
    std::size_t part = 0;
    Duration offset;          ///< in the file
    std::optional<Time> utc;  ///< where the file tells when it began
  };
  [[nodiscard]] Place place_of(Time in_sequence) const;

  /// What a person should know of the files: their order, gaps, overlaps, files that were cut short.
  [[nodiscard]] std::vector<std::string> remarks() const;

 private:
  Sequence() = default;
  void add(const std::filesystem::path& path, const StatedTimes& stated);

  std::vector<Part> parts_;
  std::size_t files_ = 0;
  std::vector<std::string> unreadable_;
};

/// Frames of a piece, but for the last of a part. Of one channel: some megabytes of memory for a file of many channels.
inline constexpr std::size_t kPieceFrames = 4096;

/// A piece of one channel of a sequence.
struct Piece {
  std::uint64_t begin = 0;  ///< its first frame in the sequence
  std::size_t part = 0;
  bool follows_on = true;  ///< sound goes on from the piece before
  std::span<const float> samples;
};

/// Reads one channel of a sequence from its beginning, a piece at a time.
class SequenceReader {
 public:
  /// @param channel  from 0
  /// @param full_scale  what a sample of 1.0 becomes the share of: samples are divided by it
  SequenceReader(const Sequence& sequence, std::size_t channel, double full_scale);

  /// Nothing at the end. The samples stay until the next call.
  [[nodiscard]] std::optional<Piece> next();

  /// Frames that the files' headers promised and their content did not hold.
  [[nodiscard]] std::uint64_t missing_frames() const { return missing_frames_; }

 private:
  [[nodiscard]] bool open_next();

  const Sequence* sequence_;
  std::size_t channel_;
  float scale_;
  std::size_t part_ = 0;  ///< that is read, or opened next
  std::unique_ptr<SoundFile> file_;
  std::uint64_t read_ = 0;  ///< frames of this part
  bool follows_on_ = false;
  std::uint64_t missing_frames_ = 0;
  std::vector<float> interleaved_;
  std::vector<float> samples_;
};

}  // namespace earshot::recording
