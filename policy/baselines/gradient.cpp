#include "policy/baselines/gradient.hpp"

#include <algorithm>

#include "policy/baselines/moves.hpp"

namespace earshot::baselines {

void GradientClimb::begin(Pcg32 random) {
  random_ = random;
  heading_ = random_.next() % prior_.actions.size();
  louder_ = heading_;
  turns_ = 0;
  is_first_ = true;
}

std::size_t GradientClimb::turned(std::size_t from, std::ptrdiff_t by) const {
  const auto count = static_cast<std::ptrdiff_t>(prior_.actions.size());
  return static_cast<std::size_t>(((static_cast<std::ptrdiff_t>(from) + by) % count + count) % count);
}

std::size_t GradientClimb::choose(const DecisionInput& input) {
  const bool is_fainter = !before_.too_faint && (input.reception.too_faint || input.reception.snr < before_.snr);
  if (!is_first_ && is_fainter) {
    ++turns_;
    const auto by = static_cast<std::ptrdiff_t>(std::max<std::size_t>(1, prior_.actions.size() / 4) + (turns_ - 1) / 2);
    heading_ = turned(louder_, turns_ % 2 == 1 ? by : -by);
  } else {
    turns_ = 0;
    louder_ = heading_;
  }
  for (std::size_t i = 0; i < prior_.actions.size() && border_cost(prior_.settings, end_of(prior_, input.position, heading_)) > 0.0; ++i) {
    heading_ = turned(heading_, 1);
  }
  is_first_ = false;
  before_ = input.reception;
  return heading_;
}

}  // namespace earshot::baselines
