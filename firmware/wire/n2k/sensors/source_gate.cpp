#include "firmware/wire/n2k/sensors/source_gate.hpp"

namespace earshot::n2k {

bool SourceGate::is_same(const Holder& holder, const Origin& origin, std::optional<Name> name) {
  if (holder.origin.pgn != origin.pgn || holder.origin.instance != origin.instance) return false;
  return holder.name ? holder.name == name : holder.origin.address == origin.address;
}

bool SourceGate::admits(const Origin& origin, const Directory& directory, Time now, Duration timeout) {
  const std::optional<Name> name = directory.name_of(origin.address);
  if (choice_.instance && choice_.instance != origin.instance) return false;
  if (choice_.name && choice_.name != name) return false;
  if (holder_ && !is_same(*holder_, origin, name) && lies_within(holder_->last, now, timeout)) return false;
  holder_ = Holder{.origin = origin, .name = name, .last = now};
  return true;
}

}  // namespace earshot::n2k
