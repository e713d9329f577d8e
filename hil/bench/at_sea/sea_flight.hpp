#pragma once

#include <filesystem>

#include "hil/bench/bench_flight.hpp"
#include "hil/bench/case.hpp"

namespace earshot::hil {

/// In the folder of a flight: what is in its computer's memory, which no crash of a program and no disk takes.
inline constexpr const char* kMemory = "memory";

/// Flies a case as at sea, `Case::speed` times as fast: earshotd without a simulator, with --resume, and beside it the vehicle's program
/// (earshot-emulate), whose operator gives START and COMPLETE. The bench listens on their bus, and faults hit the two programs and the
/// computer that they are on. Time 0 is when the search has begun.
/// @param folder  is there, and holds nothing of an earlier flight
/// @throws std::system_error when the bench itself cannot work
[[nodiscard]] BenchFlight fly_at_sea(const Case& c, const Bench& bench, const std::filesystem::path& folder);

}  // namespace earshot::hil
