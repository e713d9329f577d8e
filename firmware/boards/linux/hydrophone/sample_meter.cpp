#include "firmware/boards/linux/hydrophone/sample_meter.hpp"

namespace earshot::board {
namespace {

/// By which a sender's clock may be set while its ADC counts on.
constexpr double kClockSet_s = 60.0;
/// After so long a silence nobody asks any more how much was said.
constexpr double kLongestSilence_s = 86'400.0;

/// Whether an ADC can have taken so many samples unheard between two blocks, by the dates that they bear.
bool is_plausible(std::uint64_t missing, const messages::HydrophoneBlock& before, const messages::HydrophoneBlock& after) {
  const double missing_s = static_cast<double>(missing) / after.sample_rate.value;
  const double elapsed_s = 1e-6 * (static_cast<double>(after.time.us) - static_cast<double>(before.time.us));
  return missing_s <= kLongestSilence_s && missing_s <= elapsed_s + kClockSet_s;
}

}  // namespace

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
  if (!is_plausible(missing, last_, block)) {
    jumps_.add(1);
    return;
  }
  samples_missing_.add(missing);
  if (block.sequence - 1 == last_.sequence) missing_at_sender_.add(missing);
}

SampleMeter::Reading SampleMeter::read() const {
  return {.samples_heard = samples_heard_.value(),
          .samples_missing = samples_missing_.value(),
          .missing_at_sender = missing_at_sender_.value(),
          .overflows = overflows_.value(),
          .gain_changes = gain_changes_.value(),
          .beginnings = beginnings_.value(),
          .jumps = jumps_.value()};
}

}  // namespace earshot::board
