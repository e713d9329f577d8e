#include "hil/bench/fault.hpp"

#include <cmath>
#include <numbers>
#include <sstream>

namespace earshot::hil {

bool has_direction(Fault fault) {
  return fault == Fault::kCurrent || fault == Fault::kPositionError || fault == Fault::kSecondNavigation;
}

NorthEast TimedFault::vector() const {
  const double angle = direction_deg * std::numbers::pi / 180.0;
  return {Meters{amount * std::cos(angle)}, Meters{amount * std::sin(angle)}};
}

std::string in_words(const TimedFault& fault) {
  const auto index = static_cast<std::size_t>(fault.fault);
  const FaultTraits& traits = kFaultTraits.at(index);
  std::string word(traits.word);
  for (char& character : word) character = character == '_' ? ' ' : character;
  std::ostringstream text;
  text << word;
  if (!traits.amount.empty()) {
    std::string unit(traits.amount);
    for (char& character : unit) character = character == '_' ? ' ' : character;
    text << " " << fault.amount << " " << unit;
  }
  if (index < kFrameFaults) {
    text << " of " << fault.share * 100.0 << " % of " << (fault.device.empty() ? "all" : "the " + fault.device + "'s") << " frames";
    if (fault.pgn) text << " of " << *fault.pgn;
  }
  text << " from " << (fault.from - Time{}).to_seconds() << " s";
  if (fault.until) text << " for " << (*fault.until - fault.from).to_seconds() << " s";
  return text.str();
}

}  // namespace earshot::hil
