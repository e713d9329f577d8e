#pragma once

#include "firmware/policy/belief.hpp"
#include "sim/search/settings.hpp"
#include "sim/sonar/snr_curve.hpp"

namespace earshot::search {

/// What a vehicle that knows the search, and one ocean's SNR against range, takes for granted: the curve in steps of 100 m or as many as
/// fit, and the hypotheses of `policy::BeliefHypothesis` that cover how true oceans and loudspeakers differ from it.
[[nodiscard]] policy::BeliefModel belief_model(const SearchSettings& settings, const sonar::SnrCurve& curve);

}  // namespace earshot::search
