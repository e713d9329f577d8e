#pragma once

#include <memory>
#include <string>
#include <vector>

#include "sim/annotation/score.hpp"
#include "sim/apps/listen/arguments.hpp"
#include "sim/apps/listen/chain.hpp"
#include "sim/apps/listen/channel_detector.hpp"
#include "sim/recording/sequence.hpp"
#include "sim/spectrum/band_levels.hpp"
#include "sim/spectrum/spectrogram.hpp"

namespace earshot::listen {

/// What is to be listened to, and how: all that can be judged before the work.
struct Plan {
  recording::Sequence sequence;
  std::size_t channel = 0;  ///< from 0
  Chain chain;
  detector::SoundSettings settings;
  detector::Band asked;                     ///< of which settings.band is the part that the recording holds
  std::vector<annotation::Interval> truth;  ///< empty without --score
  std::vector<std::string> remarks;         ///< for standard error
};

/// Throws host::BadInput for what cannot be listened to.
[[nodiscard]] Plan plan_for(const Arguments& arguments);

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
  std::vector<annotation::OperatingPoint> curve;  ///< empty without --roc
  std::unique_ptr<spectrum::Spectrogram> spectrogram;
  std::unique_ptr<spectrum::BandLevels> levels;
};

/// Reads the recording from one end to the other. Throws host::BadInput where none of it could be heard.
[[nodiscard]] Heard listen_to(const Plan& plan, const Arguments& arguments);

[[nodiscard]] annotation::Score score_of(const std::vector<Row>& rows, const Plan& plan, double tolerance_s, double listened_s);

}  // namespace earshot::listen
