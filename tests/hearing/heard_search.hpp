#pragma once

#include <cstdint>
#include <vector>

#include "firmware/detector/hydrophone/settings.hpp"
#include "firmware/host/mission/mission_verifier.hpp"
#include "sim/apps/fly/flight_plan.hpp"
#include "sim/search/scenario/world.hpp"

namespace earshot::hearing {

/// What a detector of one integration time told of one moment, and what was modelled over the same time.
struct Measurement {
  double time_s = 0.0;
  double snr_db = 0.0;
  bool too_faint = false;
  double modelled_db = 0.0;  ///< of the mean intensity over the integration time
};

/// A search by the vehicle's own runtime.
struct Search {
  bool is_found = false;
  double reward = 0.0;
  std::vector<std::vector<Measurement>> measurements;  ///< of each detector
};

/// What searches have in common.
struct Rig {
  const fly::FlightPlan& plan;
  const search::World& world;
  const host::SignedSearch& flown;  ///< policy and ocean tables
};

/// A search in one process, without buses: source and start as `sim/fly` has them of this seed. The policy flies on the first detector's
/// measurements; without detectors it is told the modelled SNR.
[[nodiscard]] Search fly_search(const Rig& rig, const std::vector<detector::SoundSettings>& detectors, std::uint64_t seed);

}  // namespace earshot::hearing
