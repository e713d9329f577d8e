#include "firmware/boards/linux/outage/outage_time.hpp"

#include <algorithm>

namespace earshot::board {

Outage outage_since(const host::SafetyRecord& record, const HostClock& now) {
  const Duration running = now.since_boot();
  const Duration since = running - record.since_boot;
  const BootId boot = now.boot();
  const bool is_known = boot != BootId{} && record.boot != BootId{};
  const bool may_be_same = since >= Duration{} && (!is_known || boot == record.boot);
  if (is_known && may_be_same) return {.passed = since, .least = {}};
  // Where nobody knows whether it has started again, it was no less in either case.
  const Duration least = may_be_same ? since : running;
  return {.passed = std::clamp(now.utc() - record.utc, least, std::max(least, kMostByWallClock)),
          .least = may_be_same ? Duration{} : least};
}

}  // namespace earshot::board
