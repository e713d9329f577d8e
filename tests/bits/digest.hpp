#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <span>

#include "firmware/core/crc32.hpp"
#include "firmware/detector/hydrophone/estimate.hpp"
#include "firmware/policy/golden.hpp"
#include "firmware/runtime/runtime.hpp"

namespace earshot::bits {

/// CRC-32 of values as the bits that they are, the lowest first, whatever the machine has between them.
class Digest {
 public:
  void add(std::uint64_t bits) {
    std::array<std::uint8_t, sizeof(bits)> bytes{};
    for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<std::uint8_t>(bits >> (8U * i));
    crc_ = crc32(bytes, crc_);
  }
  void add(double x) { add(std::bit_cast<std::uint64_t>(x)); }
  void add(float x) { add(std::uint64_t{std::bit_cast<std::uint32_t>(x)}); }
  void add(Time time) { add(static_cast<std::uint64_t>(time.us)); }
  void add(NorthEast place) {
    add(place.north.value);
    add(place.east.value);
  }
  void add(std::span<const float> values) {
    for (const float value : values) add(value);
  }

  void add(const detector::Estimate& estimate);
  void add(const messages::BeliefSummary& belief);
  void add(const messages::Decision& decision);
  void add(const messages::Setpoint& setpoint);
  void add(const messages::SafetyEvent& event);
  void add(const messages::Health& health);
  /// @param elements  of an observation  @param actions  that there are logits of
  void add(const policy::GoldenStep& step, std::size_t elements, std::size_t actions);

  [[nodiscard]] std::uint32_t value() const { return crc_; }

 private:
  std::uint32_t crc_ = 0;
};

}  // namespace earshot::bits
