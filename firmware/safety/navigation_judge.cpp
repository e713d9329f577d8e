#include "firmware/safety/navigation_judge.hpp"

#include <algorithm>

#include "firmware/safety/depth_estimate.hpp"

namespace earshot::safety {
namespace {

constexpr std::uint32_t kOfOneSender = 3;  ///< two stray fixes may lie at one place by chance

}  // namespace

void NavigationJudge::hold(std::uint8_t port, Time arrival) {
  port_ = port;
  held_ = arrival;
}

bool NavigationJudge::belongs_to_another(std::uint8_t port, Time arrival) const {
  return newest_ && port != port_ && arrival - held_ <= kHandover;
}

void NavigationJudge::compare(Time arrival, const messages::Navigation& fix) {
  if (!messages::is_usable(fix) || !lies_within(fix.time, arrival, timeout_)) return;
  messages::Navigation dated = fix;
  dated.time = std::min(fix.time, arrival);
  const Meters off = contradiction(dated);
  if (!(off > Meters{0.0})) way_together_ = Meters{0.0};
  dispute(arrival, off - std::min(way_together_ * kDriftShare, kMostNoise));
  compare_depth(arrival, dated);
}

Meters NavigationJudge::contradiction(const messages::Navigation& dated) const {
  const Mark other = mark_of(dated);
  const Mark newest = mark_of(*newest_);
  return other.time < newest.time ? excess(other, newest, kNoise) : excess(newest, other, kNoise);
}

void NavigationJudge::compare_depth(Time arrival, const messages::Navigation& dated) {
  const double seconds = (dated.time - newest_->time).to_seconds();
  const Meters way = dated.depth - newest_->depth;
  const Meters by = std::max(way, -way) - Meters{DepthEstimate::kFastestSink.value * std::max(seconds, -seconds)} - DepthEstimate::kOff;
  if (!(by > Meters{0.0})) return;
  depth_disputed_ = arrival;
  depth_dispute_ = by;
}

void NavigationJudge::dispute(Time arrival, Meters by) {
  if (!(by > Meters{0.0})) return;
  const Duration apart = arrival - disputed_;
  dispute_memory_ = dispute_ > Meters{0.0} && apart <= kSlowestSender ? std::max(kJumpMemory, apart + apart) : kJumpMemory;
  disputed_ = arrival;
  dispute_ = by;
}

Meters NavigationJudge::dispute(Time now) const {
  const Meters of_place = now - disputed_ > dispute_memory_ ? Meters{0.0} : dispute_;
  return std::max(of_place, now - depth_disputed_ > kJumpMemory ? Meters{0.0} : depth_dispute_);
}

bool NavigationJudge::take(Time arrival, const messages::Navigation& fix, bool is_to_move) {
  if (!messages::is_usable(fix) || !lies_within(fix.time, arrival, timeout_) || fix.time > arrival + kMostAhead) return false;
  messages::Navigation dated = fix;
  dated.time = std::min(fix.time, arrival);  // a sender whose clock is fast does not stay fresh for longer
  if (newest_ && dated.time < newest_->time) {
    dispute(arrival, contradiction(dated));
    compare_depth(arrival, dated);
    return false;
  }
  const bool starts_over = !newest_ || (!is_to_move && arrival - newest_->time > timeout_);  // carried about, as on a ship's deck
  if (!starts_over) compare_depth(arrival, dated);
  const Mark mark = mark_of(dated);
  const Meters jump = starts_over ? Meters{0.0} : excess(mark);
  const bool corrects = jump > Meters{0.0} && is_correction(mark, jump);
  const bool is_believed = corrects || !(jump > Meters{0.0});
  count(!is_believed);
  if (!is_believed) {
    refuse(arrival, mark, jump);
    return false;
  }
  if (corrects) correct(dated.time, jump);
  newest_is_correction_ = starts_over || corrects;
  if (newest_is_correction_) {
    anchor_ = {.old = mark, .next = mark};
    young_anchor_ = anchor_;
  }
  believe(arrival, dated, is_to_move);
  return true;
}

/// By how much they lie further apart than the vehicle can have gone; zero if it can.
Meters NavigationJudge::excess(const Mark& from, const Mark& to, Meters noise) const {
  const double seconds = (to.time - from.time).to_seconds();
  const Meters way = (vehicle_.max_speed + vehicle_.max_current).value * seconds * Meters{1.0} + noise;
  return std::max(range_between(from.position, to.position) - way, Meters{0.0});
}

/// An anchor may be as far off as a fix that was believed may be, and so may this one.
Meters NavigationJudge::excess(const Mark& fix) const {
  constexpr Meters kOfBoth = 2.0 * kNoise;
  return std::max({excess(mark_of(*newest_), fix, kNoise), excess(anchor_.old, fix, kOfBoth), excess(young_anchor_.old, fix, kOfBoth)});
}

/// Remembers a fix that lies too far off.
bool NavigationJudge::is_correction(const Mark& fix, Meters jump) {
  const bool goes_on = refused_ && fix.time >= refused_->time && !(excess(*refused_, fix, kNoise) > Meters{0.0});
  if (!goes_on) correction_began_ = fix.time;
  refused_ = fix;
  const Meters corrected = corrected_before(fix.time) + jump;
  return goes_on && corrected <= kMostCorrection && fix.time - correction_began_ >= kCorrectionPatience;
}

Meters NavigationJudge::corrected_before(Time time) const {
  Meters sum;
  for (const Correction& correction : corrections_) sum = sum + (is_recent(correction, time) ? correction.by : Meters{0.0});
  return sum;
}

void NavigationJudge::correct(Time time, Meters jump) {
  FixedVector<Correction, config::kMaxCorrections> recent;
  const auto add = [&recent](const Correction& correction) { static_cast<void>(recent.push_back(correction)); };  // there is room
  for (const Correction& correction : corrections_) {
    if (is_recent(correction, time)) add(correction);
  }
  add({.time = time, .by = jump + kNoise});
  corrections_ = recent;
}

/// One that is noise makes nobody forget one that is not.
void NavigationJudge::refuse(Time arrival, const Mark& fix, Meters by) {
  const bool is_far = by > kMostNoise;
  if (!is_far && jump(arrival) > kMostNoise) return;
  jump_ = by;
  jump_seen_ = arrival;
  if (is_far) remember_sender(fix);
}

void NavigationJudge::remember_sender(const Mark& fix) {
  const bool goes_on =
      other_sender_ && lies_within(other_sender_->time, fix.time, kSlowestSender) && !(excess(*other_sender_, fix, kNoise) > Meters{0.0});
  other_senders_fixes_ = goes_on ? std::min(other_senders_fixes_ + 1, kOfOneSender) : 1;
  const Duration apart = goes_on ? fix.time - other_sender_->time : Duration{};
  jump_memory_ = other_senders_fixes_ == kOfOneSender ? std::max(kJumpMemory, apart + apart) : kJumpMemory;
  other_sender_ = fix;
}

void NavigationJudge::count(bool is_refused) {
  constexpr double kOfOne = 1.0 / 16.0;
  refused_share_ += kOfOne * ((is_refused ? 1.0 : 0.0) - refused_share_);
}

void NavigationJudge::believe(Time arrival, const messages::Navigation& fix, bool is_to_move) {
  const bool stays = newest_ && newest_->position == fix.position && is_to_move;
  if (!stays) moved_ = fix.time;
  const Meters away = range_between(left_at_, fix.position);
  if (away < away_) came_nearer_ = fix.time;
  away_ = away;
  if (!newest_ || !is_to_move || away > kJitter) {
    left_ = came_nearer_ = fix.time;
    left_at_ = fix.position;
    away_ = Meters{0.0};
  }
  if (newest_is_correction_) counted_ = fix.position;
  count_way(fix.position);
  newest_ = fix;
  refused_.reset();
  if (jump(arrival) > Meters{0.0} || dispute(arrival) > Meters{0.0}) return;  // an anchor is of a time when nobody contradicted
  move_on(anchor_, mark_of(fix), kAnchorAge);
  move_on(young_anchor_, mark_of(fix), kYoungAnchorAge);
}

void NavigationJudge::count_way(NorthEast place) {
  const Meters stride = range_between(counted_, place);
  if (stride < kStride) return;
  way_together_ = way_together_ + stride;
  counted_ = place;
}

void NavigationJudge::move_on(Anchor& anchor, const Mark& fix, Duration age) {
  if (fix.time - anchor.next.time < age) return;
  anchor = {.old = anchor.next, .next = fix};
}

Meters NavigationJudge::jump(Time now) const {
  if (now - jump_seen_ > jump_memory_) return Meters{0.0};
  return jump_ > kMostNoise || refused_share_ > kNoisyShare ? jump_ : Meters{0.0};
}

Duration NavigationJudge::frozen() const {
  if (!newest_) return {};
  const Duration jitters = newest_->time - left_;
  const bool goes_away = away_ > kLastDigits && newest_->time - came_nearer_ >= kSlowMove;
  return std::max(newest_->time - moved_, jitters > kSlowMove && !goes_away ? jitters : Duration{});
}

}  // namespace earshot::safety
