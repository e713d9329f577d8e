#include "sim/apps/fly/flight_progress.hpp"

#include <algorithm>

#include "firmware/host/text/numbers.hpp"

namespace earshot::fly {
std::string hours_and_minutes(Duration duration) {
  const std::int64_t minutes = (duration.us + Duration::seconds(30).us) / Duration::seconds(60).us;  // rounded, as on the report's page
  const std::string past_the_hour = std::to_string(minutes % 60);
  return std::to_string(minutes / 60) + " h " + (past_the_hour.size() < 2 ? "0" : "") + past_the_hour + " min";
}

std::string to_string(const FlightProgress& p) {
  if (p.is_learning_noise) return hours_and_minutes(p.at_sea) + " at sea, learning the noise of the sea before the search begins";
  std::string text = hours_and_minutes(p.at_sea) + " at sea, step " + std::to_string(std::min(p.steps_taken + 1, p.max_steps)) + " of " +
                     std::to_string(p.max_steps) + ", SNR " + (p.reception.too_faint ? "below " : "") +
                     host::decimals(p.reception.snr.value, 1) + " dB";
  if (p.believed_range) text += ", source believed " + host::decimals(p.believed_range->value / 1e3, 1) + " km away";
  return text;
}

}  // namespace earshot::fly
