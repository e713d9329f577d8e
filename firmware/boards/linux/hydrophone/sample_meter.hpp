#pragma once

#include <cstdint>

#include "firmware/boards/linux/hydrophone/sample_sink.hpp"
#include "firmware/boards/linux/hydrophone/shared_counter.hpp"

namespace earshot::board {

/// Keeps account of every sample that a hydrophone's ADC took: heard or missing, wherever it was lost. Can be read in any thread.
///
/// The sample counter tells what is missing, the sequence of blocks where it got lost: on its way, or before it was sent. A counter that
/// goes back, another sample rate or another number of channels is a sender's new beginning, at which nothing is missing. So is a counter
/// that jumps further than its ADC can have counted meanwhile: a block of nonsense must not spoil the account of a whole mission.
class SampleMeter final : public SampleSink {
 public:
  struct Reading {
    std::uint64_t samples_heard = 0;      ///< of each channel
    std::uint64_t samples_missing = 0;    ///< of each channel, between blocks
    std::uint64_t missing_at_sender = 0;  ///< of these, those between two blocks of which neither was lost
    std::uint64_t overflows = 0;          ///< samples that the ADC clipped, of all channels
    std::uint64_t gain_changes = 0;
    std::uint64_t beginnings = 0;  ///< 1 once a sender was heard
    std::uint64_t jumps = 0;  ///< of the counter, further than a minute beyond the sender's own dates or than a day: a restart or nonsense
  };

  void hear(const messages::HydrophoneBlock& block, std::span<const float> samples) override;
  [[nodiscard]] Reading read() const;

 private:
  void compare_with_last(const messages::HydrophoneBlock& block);

  messages::HydrophoneBlock last_;
  SharedCounter samples_heard_;
  SharedCounter samples_missing_;
  SharedCounter missing_at_sender_;
  SharedCounter overflows_;
  SharedCounter gain_changes_;
  SharedCounter beginnings_;
  SharedCounter jumps_;
};

}  // namespace earshot::board
