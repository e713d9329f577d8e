#include "firmware/boards/linux/can/trouble_watch.hpp"

namespace earshot::board {
namespace {

void set(BusTroubles& troubles, BusTrouble trouble, bool is_there) {
  troubles.set(static_cast<std::size_t>(trouble), is_there);
}

}  // namespace

void TroubleWatch::Growth::check(std::uint64_t count, Now now) {
  if (count_ == count) return;
  grown_ = count_ ? count > *count_ : count > 0;
  count_ = count;
  last_ = now;
}

void TroubleWatch::Growth::restart(std::uint64_t count, Now now) {
  count_ = count;
  grown_ = false;
  last_ = now;
}

void TroubleWatch::restart(const BusSigns& signs, Now now) {
  fixes_.restart(signs.fixes, now);
  measurements_.restart(signs.measurements, now);
  lost_.restart(signs.frames_lost, now);
  unsent_.restart(signs.unsent, now);
  without_address_since_.reset();
}

BusTroubles TroubleWatch::check(const BusSigns& signs, Now now) {
  fixes_.check(signs.fixes, now);
  measurements_.check(signs.measurements, now);
  no_variation_.check(signs.no_variation, now);
  other_positions_.check(signs.not_chosen.position, now);
  other_headings_.check(signs.not_chosen.heading, now);
  other_pressures_.check(signs.not_chosen.pressure, now);
  other_measurements_.check(signs.not_chosen.snr, now);
  lost_.check(signs.frames_lost, now);
  unsent_.check(signs.unsent, now);
  if (signs.has_address) without_address_since_.reset();
  if (!signs.has_address && !without_address_since_) without_address_since_ = now.host;
  BusTroubles troubles;
  set(troubles, BusTrouble::kNoAddress, without_address_since_ && now.host - *without_address_since_ >= kClaimPatience);
  set(troubles, BusTrouble::kSameName, signs.own_name_claims > 0);
  set(troubles, BusTrouble::kErrorPassive, signs.controller == n2k::ControllerState::kErrorPassive);
  set(troubles, BusTrouble::kBusOff, signs.controller == n2k::ControllerState::kBusOff);
  set(troubles, BusTrouble::kFramesLost, lost_.has_grown_within(kLossTime, now));
  set(troubles, BusTrouble::kUnsent, unsent_.has_grown_within(kPatience, now));
  if (roles_.has(host::Role::kSnr))
    set(troubles, missing(BusTrouble::kNoSnr, BusTrouble::kOtherSnr, other_measurements_, now), measurements_.is_silent(now));
  if (roles_.has(host::Role::kNavigation) && fixes_.is_silent(now)) note_missing_parts(signs.readings, now, troubles);
  return troubles;
}

/// What a fix is waiting for.
void TroubleWatch::note_missing_parts(const n2k::Readings& readings, Now now, BusTroubles& troubles) const {
  const bool has_position = n2k::is_fresh(readings.position, now.mission, kPatience);
  const Time position = has_position ? readings.position->time : now.mission;
  const bool has_heading = n2k::is_fresh(readings.heading, position, oldest_part_);
  const bool has_depth = n2k::is_fresh(readings.depth, position, oldest_part_);
  const bool is_magnetic = no_variation_.has_grown_within(kPatience, now);
  const bool is_absolute = n2k::is_fresh(readings.pressure_pa, position, oldest_part_);
  set(troubles, missing(BusTrouble::kNoPosition, BusTrouble::kOtherPosition, other_positions_, now), !has_position);
  set(troubles, BusTrouble::kFarAway, has_position && has_heading && has_depth);
  const BusTrouble no_heading = missing(BusTrouble::kNoHeading, BusTrouble::kOtherHeading, other_headings_, now);
  const BusTrouble no_depth = missing(BusTrouble::kNoDepth, BusTrouble::kOtherPressure, other_pressures_, now);
  set(troubles, is_magnetic ? BusTrouble::kNoVariation : no_heading, !has_heading);
  set(troubles, is_absolute ? BusTrouble::kSurfaceUnknown : no_depth, !has_depth);
}

}  // namespace earshot::board
