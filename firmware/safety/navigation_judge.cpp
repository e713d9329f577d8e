#include "firmware/safety/navigation_judge.hpp"

#include <algorithm>

namespace earshot::safety {

bool NavigationJudge::take(Time arrival, const messages::Navigation& fix, bool is_to_move) {
  if (!messages::is_usable(fix) || !lies_within(fix.time, arrival, timeout_) || fix.time > arrival + kMostAhead) return false;
  messages::Navigation dated = fix;
  dated.time = std::min(fix.time, arrival);  // a sender whose clock is fast does not stay fresh for longer
  if (newest_) {
    if (dated.time < newest_->time) return false;
    const Meters jump = excess(*newest_, dated);
    const bool starts_over = !is_to_move && arrival - newest_->time > timeout_;  // carried about before its search, as on a ship's deck
    if (jump > Meters{0.0} && !starts_over && !is_correction(dated, jump)) {
      jump_ = jump;
      jump_seen_ = arrival;
      return false;
    }
  }
  believe(dated, is_to_move);
  return true;
}

/// By how much they lie further apart than the vehicle can have gone; zero if it can.
Meters NavigationJudge::excess(const messages::Navigation& from, const messages::Navigation& to) const {
  const double seconds = (to.time - from.time).to_seconds();
  const Meters way = (vehicle_.max_speed + vehicle_.max_current).value * seconds * Meters{1.0} + kNoise;
  return std::max(range_between(from.position, to.position) - way, Meters{0.0});
}

/// Remembers a fix that lies too far off.
bool NavigationJudge::is_correction(const messages::Navigation& fix, Meters jump) {
  const bool goes_on = refused_ && fix.time >= refused_->time && !(excess(*refused_, fix) > Meters{0.0});
  if (!goes_on) correction_began_ = fix.time;
  refused_ = fix;
  return goes_on && jump <= kMostCorrection && fix.time - correction_began_ >= kCorrectionPatience;
}

void NavigationJudge::believe(const messages::Navigation& fix, bool is_to_move) {
  const bool stays = newest_ && newest_->position == fix.position && is_to_move;
  if (!stays) moved_ = fix.time;
  newest_ = fix;
  refused_.reset();
}

Meters NavigationJudge::jump(Time now) const {
  return jump_ > Meters{0.0} && now - jump_seen_ <= kJumpMemory ? jump_ : Meters{0.0};
}

Duration NavigationJudge::frozen() const {
  return newest_ ? newest_->time - moved_ : Duration{};
}

}  // namespace earshot::safety
