#include "firmware/boards/linux/hydrophone/sample_meter.hpp"

namespace earshot::board {

void SampleMeter::hear(const messages::HydrophoneBlock& block, std::span<const float> /*samples*/) {
  if (beginnings_.value() == 0) {
    beginnings_.add(1);
  } else {
    compare_with_last(block);
  }
  samples_heard_.add(block.samples_per_channel);
  overflows_.add(block.overflow_count);
  last_ = block;
}

void SampleMeter::compare_with_last(const messages::HydrophoneBlock& block) {
  if (block.gain != last_.gain) gain_changes_.add(1);
  const std::int64_t expected = last_.first_sample + last_.samples_per_channel;
  if (block.sample_rate != last_.sample_rate || block.channels != last_.channels || block.first_sample < expected) {
    beginnings_.add(1);
    return;
  }
  const auto missing = static_cast<std::uint64_t>(block.first_sample - expected);
  samples_missing_.add(missing);
  if (block.sequence == last_.sequence + 1) missing_at_sender_.add(missing);
}

SampleMeter::Reading SampleMeter::read() const {
  return {.samples_heard = samples_heard_.value(),
          .samples_missing = samples_missing_.value(),
          .missing_at_sender = missing_at_sender_.value(),
          .overflows = overflows_.value(),
          .gain_changes = gain_changes_.value(),
          .beginnings = beginnings_.value()};
}

}  // namespace earshot::board
