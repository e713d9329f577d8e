#include "sim/apps/fly/flight_progress.hpp"

#include <algorithm>

#include "firmware/host/text/duration.hpp"
#include "firmware/host/text/numbers.hpp"

namespace earshot::fly {

std::string to_string(const FlightProgress& p) {
  if (p.is_learning_noise) return host::duration(p.at_sea.to_seconds()) + " at sea, learning the noise of the sea before the search begins";
  std::string text = host::duration(p.at_sea.to_seconds()) + " at sea, step " + std::to_string(std::min(p.steps_taken + 1, p.max_steps)) +
                     " of " + std::to_string(p.max_steps) + ", SNR " + (p.reception.too_faint ? "below " : "") +
                     host::decimals(p.reception.snr.value, 1) + " dB";
  if (p.believed_range) text += ", source believed " + host::decimals(p.believed_range->value / 1e3, 1) + " km away";
  return text;
}

}  // namespace earshot::fly
