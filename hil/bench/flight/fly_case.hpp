#pragma once

#include <filesystem>

#include "hil/bench/bench_flight.hpp"
#include "hil/bench/case.hpp"

namespace earshot::hil {

/// Flies a case; one with a speed as at_sea/sea_flight.hpp does. In lock-step: earshotd, a simulator's clock in its place of time, and a
/// vehicle's devices on its bus between whom and Earshot the faults are; over LCM messages take the place of frames. Every tick is a
/// second, as a turn at sea is; what the devices say in it is on the bus before the tick, and a message that has a shorter period is said
/// once.
/// @param folder  made; what it holds of an earlier flight is replaced
/// @return also of a flight that the bench could not fly, or not to its end (BenchFlight::failure): the other cases are flown all the same
[[nodiscard]] BenchFlight fly_case(const Case& c, const Bench& bench, const std::filesystem::path& folder);

}  // namespace earshot::hil
