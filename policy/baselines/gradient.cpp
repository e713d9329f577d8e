#include "policy/baselines/gradient.hpp"

#include "policy/baselines/moves.hpp"

namespace earshot::baselines {

void GradientClimb::begin(Pcg32 random) {
  random_ = random;
  heading_ = random_.next() % briefing_.actions.size();
  turns_ = 0;
  is_first_ = true;
}

std::size_t GradientClimb::turned(std::ptrdiff_t by) const {
  const auto count = static_cast<std::ptrdiff_t>(briefing_.actions.size());
  return static_cast<std::size_t>(((static_cast<std::ptrdiff_t>(heading_) + by) % count + count) % count);
}

std::size_t GradientClimb::choose(const Look& look) {
  const bool is_fainter = before_.measured && (!look.heard.measured || look.heard.snr < before_.snr);
  if (!is_first_ && is_fainter) {
    ++turns_;
    const auto by = static_cast<std::ptrdiff_t>((turns_ + 1) / 2 + briefing_.actions.size() / 8);
    heading_ = turned(turns_ % 2 == 1 ? by : -by);
  } else {
    turns_ = 0;
  }
  for (std::size_t i = 0; i < briefing_.actions.size() && border_cost(briefing_.settings, end_of(briefing_, look.position, heading_)) > 0.0;
       ++i) {
    heading_ = turned(1);
  }
  is_first_ = false;
  before_ = look.heard;
  return heading_;
}

}  // namespace earshot::baselines
