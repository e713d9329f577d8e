#include "policy/baselines/oracle.hpp"

#include "policy/baselines/moves.hpp"

namespace earshot::baselines {

void Oracle::begin(Pcg32 /*random*/) {}

std::size_t Oracle::choose(const DecisionInput& input) {
  return border_ == Border::kIgnored ? straight_toward(prior_, input.vehicle, input.source)
                                     : warily_toward(prior_, input.vehicle, input.source);
}

}  // namespace earshot::baselines
