#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "firmware/core/status.hpp"
#include "firmware/core/time.hpp"
#include "firmware/core/units.hpp"
#include "firmware/messages/snr_measurement.hpp"
#include "firmware/wire/n2k/frame.hpp"

namespace earshot::n2k {

// What a hydrophone and an altimeter measure, for which no standard group is there. One frame each, without a date: its arrival stands
// for it. Reading fails as decode() does, and with kUnsupported for another maker's message.

struct HeardSnr {
  Decibels snr;
  bool too_faint = false;              ///< the signal lies somewhere below `snr`
  std::optional<Decibels> band_level;  ///< dB re 1 uPa
};
/// SNR to 0.01 dB, within 600 dB of zero.
[[nodiscard]] Status compose_snr(const HeardSnr& heard, std::uint8_t source, Frame& frame);
[[nodiscard]] Result<HeardSnr> read_snr(std::span<const std::uint8_t> bytes);
/// As the runtime takes it.
[[nodiscard]] messages::SnrMeasurement measurement_of(const HeardSnr& heard, Time arrival);

/// Height over the seabed, 0.01 m.
[[nodiscard]] Status compose_altitude(Meters altitude, std::uint8_t source, Frame& frame);
[[nodiscard]] Result<Meters> read_altitude(std::span<const std::uint8_t> bytes);

}  // namespace earshot::n2k
