#include "policy/baselines/oracle.hpp"

#include "policy/baselines/moves.hpp"

namespace earshot::baselines {

void Oracle::begin(Pcg32 /*random*/) {}

std::size_t Oracle::choose(const Look& look) {
  return border_ == Border::kIgnored ? straight_toward(briefing_, look.vehicle, look.source)
                                     : warily_toward(briefing_, look.vehicle, look.source);
}

}  // namespace earshot::baselines
