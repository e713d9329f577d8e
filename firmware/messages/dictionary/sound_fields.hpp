#pragma once

#include "firmware/messages/dictionary/message.hpp"
#include "firmware/messages/hydrophone_block.hpp"

namespace earshot::messages {

/// Of all channels together.
struct SampleCount : Line {
  using Reaches = Types<At<&HydrophoneBlock::samples_per_channel>>;
  [[nodiscard]] constexpr std::array<NumberField, 1> numbers() const { return {{{.type = NumberType::kInt32, .name = name}}}; }
  static constexpr void write(const HydrophoneBlock& block, auto& out) {
    out.number(static_cast<std::int32_t>(block.samples_per_channel * block.channels));
  }
};

/// They go beside the message, as they lie in it: firmware/wire/lcm/hydrophone_block.hpp.
struct Samples : Line {
  using Reaches = Types<>;
  [[nodiscard]] constexpr std::array<NumberField, 1> numbers() const {
    return {{{.type = NumberType::kFloat, .name = name, .counted_by = "sample_count"}}};
  }
  static constexpr void write(const HydrophoneBlock& /*block*/, auto& /*out*/) {}
};

template <>
struct Described<HydrophoneBlock> {
  static constexpr std::string_view kType = "hydrophone_block_t";
  static constexpr std::string_view kChannel = "EARSHOT_HYDROPHONE_BLOCK";
  static constexpr std::string_view kMeaning =
      "Sound: the samples of all hydrophone channels over an interval. On a group or port of its own.\n"
      "At most 131 072 bytes (32 753 samples). Up to 16 000 samples it is one datagram, and what the network loses of it is no more than "
      "that.";
  static constexpr LineList kFields{
      field<&HydrophoneBlock::time>("utime", {.meaning = "when the ADC took the first sample: UTC, microseconds"}),
      field<&HydrophoneBlock::sequence>("sequence", {.meaning = "counts the sender's blocks: a gap is a block lost on its way"}),
      field<&HydrophoneBlock::first_sample>(
          "first_sample", {.meaning = "counts the ADC's samples of one channel, the first of this block: a gap is a dropout"}),
      field<&HydrophoneBlock::sample_rate>("sample_rate_hz", {.meaning = "of each channel, 250 to 96 000"}),
      field<&HydrophoneBlock::gain>("gain_db", {.meaning = "from hydrophone to ADC as it is set now, -200 to 200"}),
      field<&HydrophoneBlock::overflow_count>("overflow_count",
                                              {.meaning = "samples in this block that the ADC clipped, of all channels together"}),
      field<&HydrophoneBlock::channels>("channels", {.meaning = "1 to 8"}),
      SampleCount{{"sample_count", {.meaning = "of all channels together"}}},
      Samples{{"samples",
               {.meaning = "share of full scale, -1 to 1: ADC counts before any calibration; one of each channel, then the next "
                           "of each"}}},
  };
};

}  // namespace earshot::messages
