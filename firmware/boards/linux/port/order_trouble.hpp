#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace earshot::board {

/// What is wrong with an order that a port brought, for a person.
enum class OrderTrouble : std::uint8_t {
  kUnreadable,  ///< and it was not obeyed
  kCutAbort,    ///< and it was obeyed: the order could be read, and not the rest
  kOldMark,     ///< and it was not obeyed
  kNoMark,      ///< likewise
};
inline constexpr std::size_t kOrderTroubleCount = 4;

/// What is wrong, and what its sender is to do.
[[nodiscard]] constexpr std::string_view to_string(OrderTrouble trouble) {
  switch (trouble) {
    case OrderTrouble::kUnreadable:
      return "an order could not be read, and was not obeyed: over LCM make its sender's types anew from this version's .lcm files, and "
             "set "
             "every field; in Python mark = bytes(16), which lcm-gen leaves short without a word";
    case OrderTrouble::kCutAbort:
      return "an ABORT was obeyed whose bytes do not fit: over LCM make its sender's types anew from this version's .lcm files, and set "
             "every "
             "field; in Python mark = bytes(16), which lcm-gen leaves short without a word";
    case OrderTrouble::kOldMark:
      return "an order was refused whose mark knows the key and lacks the vehicle's challenge: its sender must mark it for "
             "EARSHOT_CHALLENGE "
             "(on CAN 130953), as marked_order.py does";
    case OrderTrouble::kNoMark:
      return "an order was refused: its mark is missing or wrong (another key, vehicle_id or mission, or recorded before this start)";
  }
  return {};
}

}  // namespace earshot::board
