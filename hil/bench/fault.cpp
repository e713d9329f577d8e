#include "hil/bench/fault.hpp"

#include <cmath>
#include <numbers>
#include <sstream>

#include "firmware/messages/dictionary/enumerators.hpp"

namespace earshot::hil {

static_assert(messages::has_a_row_for_each(kFaultTraits, &FaultTraits::fault), "a fault has no row, or it stands in another's place");

NoMaker::NoMaker(Fault fault, std::string_view where)
    : std::logic_error("the bench has nothing that makes the fault \"" + std::string(traits_of(fault).word) + "\" " + std::string(where)) {}

NorthEast TimedFault::vector() const {
  const double angle = direction_deg * std::numbers::pi / 180.0;
  return {Meters{amount * std::cos(angle)}, Meters{amount * std::sin(angle)}};
}

namespace {

std::string unit_of(const FaultTraits& traits) {
  std::string unit(traits.amount == "mps" ? "m/s" : traits.amount);
  for (char& character : unit) character = character == '_' ? ' ' : character;
  return unit;
}

}  // namespace

std::string to_string(const TimedFault& fault) {
  const FaultTraits& traits = fault.traits();
  std::string word(traits.word);
  for (char& character : word) character = character == '_' ? ' ' : character;
  std::ostringstream text;
  text.precision(12);  // a disk's bytes in full
  text << word;
  if (!fault.how.empty()) text << " (" << fault.how << ")";
  if (!traits.amount.empty()) text << " " << fault.amount << " " << unit_of(traits);
  if (traits.has_direction) text << " towards " << fault.direction_deg << " degrees";
  if (traits.hits == FaultTarget::kFrames) {
    text << " of " << fault.share * 100.0 << " % of " << (fault.device.empty() ? "all" : "the " + fault.device + "'s") << " frames";
    if (fault.pgn) text << " of " << *fault.pgn;
  } else if (!fault.device.empty()) {
    text << " of " << fault.device;
  }
  text << (traits.is_of_a_moment ? " at " : " from ") << (fault.from - Time{}).to_seconds() << " s";
  if (fault.until) text << " for " << (*fault.until - fault.from).to_seconds() << " s";
  return text.str();
}

}  // namespace earshot::hil
