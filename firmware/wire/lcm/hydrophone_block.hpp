#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "firmware/core/status.hpp"
#include "firmware/messages/hydrophone_block.hpp"

namespace earshot::wire {

/// A hydrophone_block_t as it lies in its message.
struct HydrophoneMessage {
  messages::HydrophoneBlock block;
  std::span<const std::uint8_t> samples;  ///< big-endian floats; copy_samples() reads them
  [[nodiscard]] std::size_t sample_count() const { return samples.size() / sizeof(float); }
};

/// Reads a hydrophone_block_t where it lies. (lcm-gen's type takes its samples' memory from the heap.)
/// kMalformed: of another type, of a length that does not fit its counts, or with a field outside the range that its .lcm states.
/// Samples may be anything, NaN too: what is to become of them the detector says.
/// Oracle: HydrophoneMessage tests (lcm-gen's own type as the other side)
[[nodiscard]] Status read_hydrophone_block(std::span<const std::uint8_t> bytes, HydrophoneMessage& message);

/// @param samples  message.sample_count() floats; they may lie over the message, if they begin before its own
void copy_samples(const HydrophoneMessage& message, std::span<float> samples);

/// Bytes of a hydrophone_block_t with so many samples.
[[nodiscard]] std::size_t hydrophone_block_bytes(std::size_t sample_count);

/// Writes one, as its senders do. @param bytes  hydrophone_block_bytes(samples.size()); the block says how many samples there are
void write_hydrophone_block(const messages::HydrophoneBlock& block, std::span<const float> samples, std::span<std::uint8_t> bytes);

}  // namespace earshot::wire
