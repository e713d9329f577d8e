#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sim/annotation/score.hpp"
#include "sim/listening/channel_detectors.hpp"
#include "sim/listening/plan.hpp"
#include "sim/recording/sequence.hpp"
#include "sim/spectrum/band_levels.hpp"
#include "sim/spectrum/spectrogram.hpp"

namespace earshot::listening {

/// What one detection is told as.
struct Row {
  double begin_s = 0.0;  ///< from the start of the sequence
  double duration_s = 0.0;
  double peak_s = 0.0;
  double level_db = 0.0;  ///< Chain::unit()
  double snr_db = 0.0;
  recording::Sequence::Place place;  ///< of the begin
  bool is_clipped = false;
};

/// What another threshold gives.
struct AtThreshold {
  double threshold_db = 0.0;
  std::vector<Row> rows;
};

struct Heard {
  std::vector<Row> rows;
  double listened_s = 0.0;
  double noise_db = 0.0;  ///< mean level in the band, Chain::unit()
  struct Obstacle {
    std::string what;
    double seconds = 0.0;
  };
  std::vector<Obstacle> obstacles;  ///< when it did not hear, or heard clipped sound
  std::uint64_t missing_frames = 0;
  std::vector<AtThreshold> others;  ///< with Wanted::every_threshold
  std::unique_ptr<spectrum::Spectrogram> spectrogram;
  std::unique_ptr<spectrum::BandLevels> levels;
};

/// "5 samples that the headers announce could not be read: ..."; of missing_frames.
[[nodiscard]] std::string missing_to_string(const Heard& heard);

/// The share of the work that is done, 0 to 1; called after each piece. What it throws ends the work.
using Progress = std::function<void(double)>;

/// One listening to a recording, piece by piece from its first sample to its last. Its noise is learnt from its beginning, before.
class Listening {
 public:
  /// Pieces of a recording from its first sample on, one with each call; nothing at the end.
  using Source = std::function<std::optional<recording::Piece>()>;

  /// @param plan  stays as long as this, as its caller gave it; only how long the sequence is may change
  Listening(const Plan& plan, const Wanted& wanted) : plan_(plan), detectors_(plan, wanted) {}

  /// Samples from the recording's begin on that learn() reads at least, where there are so many.
  [[nodiscard]] std::uint64_t beginning() const;
  /// To be called once, before hear(). @param from_start  gives a new source, which is read up to beginning()
  void learn(const std::function<Source()>& from_start, const Progress& progress);
  void hear(const recording::Piece& piece);
  /// After the last piece.
  void finish();

  /// Of the detections from number `first` on: those that are over.
  [[nodiscard]] std::vector<Row> rows(std::size_t first = 0) const;
  /// Of the intervals that are over; nullptr where none are wanted.
  [[nodiscard]] const spectrum::BandLevels* levels() const { return detectors_.levels(); }
  /// After finish(), once. Throws host::BadInput where none of the recording could be heard.
  [[nodiscard]] Heard heard(std::uint64_t missing_frames);

 private:
  const Plan& plan_;
  ChannelDetectors detectors_;
  std::vector<float> last_;  ///< samples
};

/// Reads a recording's files from one end to the other. Throws host::BadInput where none of it could be heard.
[[nodiscard]] Heard listen_to(const Plan& plan, const Wanted& wanted, const Progress& progress);

[[nodiscard]] annotation::Score score_of(const std::vector<Row>& rows, const std::vector<annotation::Interval>& truth, double tolerance_s,
                                         double listened_s);

}  // namespace earshot::listening
