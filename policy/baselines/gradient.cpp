#include "policy/baselines/gradient.hpp"

#include <algorithm>

#include "policy/baselines/moves.hpp"

namespace earshot::baselines {

void GradientClimb::begin(Pcg32 random) {
  random_ = random;
  heading_ = random_.next() % briefing_.actions.size();
  louder_ = heading_;
  turns_ = 0;
  is_first_ = true;
}

std::size_t GradientClimb::turned(std::size_t from, std::ptrdiff_t by) const {
  const auto count = static_cast<std::ptrdiff_t>(briefing_.actions.size());
  return static_cast<std::size_t>(((static_cast<std::ptrdiff_t>(from) + by) % count + count) % count);
}

std::size_t GradientClimb::choose(const Look& look) {
  const bool is_fainter = !before_.too_faint && (look.heard.too_faint || look.heard.snr < before_.snr);
  if (!is_first_ && is_fainter) {
    ++turns_;
    const auto by = static_cast<std::ptrdiff_t>(std::max<std::size_t>(1, briefing_.actions.size() / 4) + (turns_ - 1) / 2);
    heading_ = turned(louder_, turns_ % 2 == 1 ? by : -by);
  } else {
    turns_ = 0;
    louder_ = heading_;
  }
  for (std::size_t i = 0; i < briefing_.actions.size() && border_cost(briefing_.settings, end_of(briefing_, look.position, heading_)) > 0.0;
       ++i) {
    heading_ = turned(heading_, 1);
  }
  is_first_ = false;
  before_ = look.heard;
  return heading_;
}

}  // namespace earshot::baselines
