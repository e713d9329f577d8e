#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "firmware/core/time.hpp"
#include "sim/listening/listening.hpp"
#include "sim/recording/sound_file.hpp"

namespace earshot::listening {

/// Sound that is no file, as a sequence of one part, `samples`; how long it is may be told later.
[[nodiscard]] recording::Sequence sequence_of_samples(const recording::SoundFormat& format, std::optional<Time> start);

/// Listens to sound as it comes, in blocks of any length: the same rows, bit for bit, as from a file of all of them. The noise is learnt
/// from the recording's beginning, so the first samples, as many as the noise floor remembers, are kept until there are so many. Oracle:
/// Stream.*
class Stream {
 public:
  /// @param plan  of sequence_of_samples()
  Stream(Plan plan, const Wanted& wanted);

  /// @param samples  of the channel that is listened to, shares of full scale
  /// @param progress  of this block; where it throws, the stream is of no more use
  void push(std::span<const float> samples, const Progress& progress);
  /// After the last sample. Throws host::BadInput where none of the sound could be heard.
  [[nodiscard]] Heard finish(const Progress& progress);

  [[nodiscard]] const Plan& plan() const { return plan_; }
  [[nodiscard]] const Listening& listening() const { return listening_; }

 private:
  void learn(const Progress& progress);
  void hear_waiting(const Progress& progress, double share);
  /// Pieces of what waits, as a file's reader would cut them: whole ones, and at the end the rest.
  [[nodiscard]] Listening::Source pieces() const;

  Plan plan_;
  Listening listening_;
  bool has_learnt_ = false;
  bool is_over_ = false;
  std::uint64_t heard_ = 0;     ///< samples
  std::vector<float> waiting_;  ///< samples behind them
};

}  // namespace earshot::listening
