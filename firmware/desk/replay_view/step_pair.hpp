#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "firmware/messages/decision.hpp"

namespace earshot::replay_view {

/// One step of a search as it was decided on the flight, and as it is decided now.
struct StepPair {
  std::uint32_t step = 0;
  std::optional<messages::Decision> then;
  std::optional<messages::Decision> now;

  /// Both send the vehicle to the same place at the same time, to the last bit.
  [[nodiscard]] bool is_same() const;
};

/// By step. @param then, now  in the order in which they were made
[[nodiscard]] std::vector<StepPair> paired(std::span<const messages::Decision> then, std::span<const messages::Decision> now);

/// Those of paired() from this step on.
[[nodiscard]] std::span<const StepPair> from(std::uint32_t step, std::span<const StepPair> pairs);

/// The first that is not the same; null: there is none.
[[nodiscard]] const StepPair* parting(std::span<const StepPair> pairs);

}  // namespace earshot::replay_view
