#include "hil/nodes/sensor.hpp"

namespace earshot::hil {
namespace {

constexpr std::uint8_t kHighestCount = 252;  ///< of a SID; then it begins anew

std::vector<std::uint32_t> groups_of(const std::vector<Broadcast>& broadcasts) {
  std::vector<std::uint32_t> groups;
  groups.reserve(broadcasts.size());
  for (const Broadcast& broadcast : broadcasts) groups.push_back(broadcast.message.pgn);
  return groups;
}

}  // namespace

Sensor::Sensor(const Nameplate& plate, std::vector<Broadcast> broadcasts) : membership_(plate, groups_of(broadcasts), {}) {
  for (Broadcast& broadcast : broadcasts) {
    const Duration period = broadcast.period;
    broadcasts_.push_back({.broadcast = std::move(broadcast), .pace = Pace(period)});
  }
}

void Sensor::step(Time now, Frames& frames) {
  membership_.step(now, frames);
  const std::optional<std::uint8_t> source = membership_.address();
  if (!source) return;
  for (Paced& paced : broadcasts_) {
    if (!paced.pace.is_due(now)) continue;
    const Status status = paced.broadcast.compose({.now = now, .source = *source, .count = paced.count}, frames);
    ++(status == Status::kOk ? sent_ : unsent_);
    paced.count = paced.count == kHighestCount ? std::uint8_t{0} : static_cast<std::uint8_t>(paced.count + 1);
  }
}

}  // namespace earshot::hil
