#include "firmware/wire/lcm/hydrophone_block.hpp"

#include <bit>
#include <cassert>
#include <cstddef>

#include "firmware/config/capacities.hpp"
#include "firmware/core/big_endian.hpp"
#include "firmware/messages/dictionary/sound_fields.hpp"
#include "firmware/wire/lcm/codec.hpp"

namespace earshot::wire {
namespace {

constexpr std::uint64_t kFingerprint = lcm_fingerprint<messages::HydrophoneBlock>();
constexpr std::size_t kHeadBytes = kLcmSize<messages::HydrophoneBlock>;

/// Reads big-endian numbers one after the other; the caller has looked that they are there.
class HeadReader {
 public:
  explicit HeadReader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}
  template <class Unsigned>
  [[nodiscard]] Unsigned next() {
    Unsigned value = 0;
    for (std::size_t i = 0; i < sizeof(Unsigned); ++i)
      value = static_cast<Unsigned>(static_cast<std::uint64_t>(value) << 8U | bytes_[at_++]);
    return value;
  }
  [[nodiscard]] std::int64_t i64() { return static_cast<std::int64_t>(next<std::uint64_t>()); }
  [[nodiscard]] std::int32_t i32() { return static_cast<std::int32_t>(next<std::uint32_t>()); }
  [[nodiscard]] double f64() { return std::bit_cast<double>(next<std::uint64_t>()); }

 private:
  std::span<const std::uint8_t> bytes_;
  std::size_t at_ = 0;
};

/// False for NaN, too.
template <class Value>
bool is_within(Value lowest, Value value, Value highest) {
  return value >= lowest && value <= highest;
}

}  // namespace

Status read_hydrophone_block(std::span<const std::uint8_t> bytes, HydrophoneMessage& message) {
  if (!is_within(kHeadBytes, bytes.size(), config::kLcmMessageBytes)) return Status::kMalformed;
  HeadReader head(bytes);
  if (head.next<std::uint64_t>() != kFingerprint) return Status::kMalformed;
  messages::HydrophoneBlock block;
  block.time = {head.i64()};
  block.sequence = head.i64();
  block.first_sample = head.i64();
  block.sample_rate = Hertz{head.f64()};
  block.gain = Decibels{head.f64()};
  const std::int32_t overflow_count = head.i32();
  const auto channels = static_cast<std::int8_t>(head.next<std::uint8_t>());
  const std::int32_t sample_count = head.i32();

  const std::span<const std::uint8_t> samples = bytes.subspan(kHeadBytes);
  const bool is_consistent = is_within<std::int8_t>(1, channels, config::kHydrophoneChannels) && sample_count > 0 &&
                             samples.size() == static_cast<std::size_t>(sample_count) * sizeof(float) && sample_count % channels == 0 &&
                             is_within(std::int32_t{0}, overflow_count, sample_count);
  const bool is_possible = block.time >= Time{} && block.sequence >= 0 &&
                           is_within(std::int64_t{0}, block.first_sample, messages::kLastSample) &&
                           is_within(messages::kLowestSampleRate, block.sample_rate, messages::kHighestSampleRate) &&
                           is_within(-messages::kHighestGain, block.gain, messages::kHighestGain);
  if (!is_consistent || !is_possible) return Status::kMalformed;
  block.samples_per_channel = static_cast<std::uint32_t>(sample_count / channels);
  block.overflow_count = static_cast<std::uint32_t>(overflow_count);
  block.channels = static_cast<std::uint8_t>(channels);
  message = {.block = block, .samples = samples};
  return Status::kOk;
}

void copy_samples(const HydrophoneMessage& message, std::span<float> samples) {
  assert(samples.size() == message.sample_count());
  const std::uint8_t* from = message.samples.data();
  for (float& sample : samples) {
    sample = std::bit_cast<float>(std::uint32_t{from[0]} << 24U | std::uint32_t{from[1]} << 16U | std::uint32_t{from[2]} << 8U |
                                  std::uint32_t{from[3]});
    from += sizeof(float);
  }
}

std::size_t hydrophone_block_bytes(std::size_t sample_count) {
  return kHeadBytes + sample_count * sizeof(float);
}

void write_hydrophone_block(const messages::HydrophoneBlock& block, std::span<const float> samples, std::span<std::uint8_t> bytes) {
  assert(bytes.size() == hydrophone_block_bytes(samples.size()));
  encode(block, bytes.first<kHeadBytes>());
  std::size_t at = kHeadBytes;
  for (const float sample : samples) {
    store_big_endian(bytes.subspan(at, sizeof(float)), std::bit_cast<std::uint32_t>(sample));
    at += sizeof(float);
  }
}

}  // namespace earshot::wire
