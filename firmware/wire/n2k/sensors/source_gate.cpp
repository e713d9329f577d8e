#include "firmware/wire/n2k/sensors/source_gate.hpp"

namespace earshot::n2k {

bool SourceGate::is_same(const Holder& holder, const Origin& origin, std::optional<Name> name) {
  if (holder.origin.pgn != origin.pgn || holder.origin.instance != origin.instance) return false;
  return holder.name ? holder.name == name : holder.origin.address == origin.address;
}

SourceStatus SourceGate::status_of(const Origin& origin, const Directory& directory, Time now, Duration handover) const {
  const std::optional<Name> name = directory.name_of(origin.address);
  if (choice_.instance && choice_.instance != origin.instance) return SourceStatus::kNotChosen;
  if (choice_.name && choice_.name != name) return SourceStatus::kNotChosen;
  if (!holder_) return SourceStatus::kIsFree;
  if (is_same(*holder_, origin, name)) return SourceStatus::kHolds;
  return lies_within(holder_->last, now, handover) ? SourceStatus::kHeldByAnother : SourceStatus::kIsFree;
}

void SourceGate::hold(const Origin& origin, const Directory& directory, Time now) {
  holder_ = Holder{.origin = origin, .name = directory.name_of(origin.address), .last = now};
}

}  // namespace earshot::n2k
