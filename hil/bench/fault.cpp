#include "hil/bench/fault.hpp"

#include <cmath>
#include <numbers>
#include <sstream>

namespace earshot::hil {

bool has_direction(Fault fault) {
  return fault == Fault::kCurrent || fault == Fault::kPositionError || fault == Fault::kSecondNavigation || leads_away(fault);
}

bool leads_away(Fault fault) {
  return fault == Fault::kPositionDrift || fault == Fault::kWalkingNavigation || fault == Fault::kPausingNavigation;
}

NorthEast TimedFault::vector() const {
  const double angle = direction_deg * std::numbers::pi / 180.0;
  return {Meters{amount * std::cos(angle)}, Meters{amount * std::sin(angle)}};
}

std::vector<std::string> subjects_of(Fault fault) {
  switch (fault) {
    case Fault::kKill:
    case Fault::kPause:
    case Fault::kStop:
      return {std::string(kEarshotsProgram), std::string(kVehiclesProgram)};
    case Fault::kFileGone:
      return {std::string(kPolicyFile), std::string(kTablesFile), std::string(kMissionFile)};
    case Fault::kOrder:
      return {std::string(kAbortOrder), std::string(kPauseOrder)};
    default:
      return {};
  }
}

bool is_of_controller(Fault fault) {
  return fault == Fault::kErrorPassive || fault == Fault::kBusOff;
}

bool is_of_sound(Fault fault) {
  return fault >= Fault::kSoundDropout && fault <= Fault::kSoundShorted;
}

namespace {

std::string unit_of(const FaultTraits& traits) {
  std::string unit(traits.amount == "mps" ? "m/s" : traits.amount);
  for (char& character : unit) character = character == '_' ? ' ' : character;
  return unit;
}

}  // namespace

std::string in_words(const TimedFault& fault) {
  const auto index = static_cast<std::size_t>(fault.fault);
  const FaultTraits& traits = kFaultTraits.at(index);
  std::string word(traits.word);
  for (char& character : word) character = character == '_' ? ' ' : character;
  std::ostringstream text;
  text.precision(12);  // a disk's bytes in full
  text << word;
  if (!fault.how.empty()) text << " (" << fault.how << ")";
  if (!traits.amount.empty()) text << " " << fault.amount << " " << unit_of(traits);
  if (has_direction(fault.fault)) text << " towards " << fault.direction_deg << " degrees";
  if (index < kFrameFaults) {
    text << " of " << fault.share * 100.0 << " % of " << (fault.device.empty() ? "all" : "the " + fault.device + "'s") << " frames";
    if (fault.pgn) text << " of " << *fault.pgn;
  } else if (!fault.device.empty()) {
    text << " of " << fault.device;
  }
  text << (is_of_a_moment(fault.fault) ? " at " : " from ") << (fault.from - Time{}).to_seconds() << " s";
  if (fault.until) text << " for " << (*fault.until - fault.from).to_seconds() << " s";
  return text.str();
}

}  // namespace earshot::hil
