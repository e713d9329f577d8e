#pragma once

#include <cstdint>
#include <functional>
#include <memory>

#include "firmware/core/geometry.hpp"
#include "firmware/core/units.hpp"
#include "hil/nodes/sensor.hpp"
#include "hil/nodes/vehicle/disturbance.hpp"
#include "sim/vehicle/vehicle.hpp"

namespace earshot::hil {

/// SNR of a source against horizontal range.
using SnrOfRange = std::function<Decibels(Meters range)>;

/// A source in the water.
struct SoundSource {
  NorthEast position;
  SnrOfRange snr;
};

/// A hydrophone with a detector of its own: the SNR of `source` at `vehicle` (65291) once a second, without any fluctuation. An SNR beyond
/// what the message can hold is not said. The vehicle's state and the fault must outlive it.
/// Oracle: Hydrophone tests
[[nodiscard]] std::unique_ptr<Sensor> make_hydrophone(const vehicle::State& vehicle, SoundSource source, const HydrophoneFault& fault,
                                                      std::uint32_t unique_number);

}  // namespace earshot::hil
