#pragma once

#include <cstdint>
#include <span>

#include "firmware/messages/operator_command.hpp"

namespace earshot::wire {

/// How much of the bytes on the channel of orders could be read.
enum class OrderForm : std::uint8_t {
  kWhole,       ///< an operator_command_t, to its last byte
  kAbort,       ///< no whole one, but what stands at its head is an ABORT: that much is enough to stop
  kUnreadable,  ///< neither
};

/// An order as somebody sent it. Of one that is not whole there are its dates, issuer, number and order, as far as these are readable, and
/// neither limits nor mark: its sender is to hear what became of it.
struct ReadOrder {
  OrderForm form = OrderForm::kUnreadable;
  messages::OperatorCommand command = {.time = {}, .expiry = {}, .order = messages::Order{0}};
};

/// The head of an operator_command_t is its first kOrderHeadBytes bytes: fingerprint, date, expiry, issuer, number, order. It is readable
/// when all of it is there, whatever follows or is missing (a mark that is too short, fields that a newer type has, a packet that was cut),
/// and the fingerprint is this type's; or it is another's, and both dates lie from 1970 to 2255 and the order is one that there is: an
/// older or a newer operator_command_t, which begins likewise.
/// Oracle: OrderReader.*
inline constexpr std::size_t kOrderHeadBytes = 33;

[[nodiscard]] ReadOrder read_order(std::span<const std::uint8_t> bytes);

}  // namespace earshot::wire
