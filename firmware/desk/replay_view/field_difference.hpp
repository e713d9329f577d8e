#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace earshot::replay_view {

/// A field of a record that is not what it was.
struct FieldDifference {
  std::string field;  ///< as earshot journal --jsonl names it: "ports[0].lost"; "byte 17" where no field says it
  std::string then;   ///< in the journal
  std::string now;
  friend bool operator==(const FieldDifference&, const FieldDifference&) = default;
};

/// What is not the same in two records of one channel, by their messages. Nothing: they are the same, byte for byte.
[[nodiscard]] std::vector<FieldDifference> field_differences(std::string_view channel, std::span<const std::uint8_t> then,
                                                             std::span<const std::uint8_t> now);

/// "state is "SEARCH" in the journal, "ABORT" now; ... and 3 fields more"
[[nodiscard]] std::string to_string(std::span<const FieldDifference> differences);

}  // namespace earshot::replay_view
