#include "firmware/boards/linux/sender_clock.hpp"

namespace earshot::board {
namespace {

constexpr Time kLatest{std::int64_t{1} << 61};  ///< far beyond any date; sums of two of these do not overflow

bool is_within(Duration difference, Duration limit) {
  return difference <= limit && Duration{} - difference <= limit;
}

}  // namespace

std::optional<Time> SenderClock::to_mission_time(Time date, Time now) {
  if (date < Time{} || date > kLatest) return std::nullopt;
  const Time moved = date + off_;
  if (is_within(now - moved, believed_)) {
    strange_.reset();
    return moved;
  }
  if (!strange_ || !is_within((date - strange_->date) - (now - strange_->now), run_slack_)) {
    strange_ = {.date = date, .now = now};
    return std::nullopt;
  }
  if (now - strange_->now < run_length_) return std::nullopt;
  off_ = now - date;
  strange_.reset();
  return now;
}

}  // namespace earshot::board
