#include "firmware/wire/lcm/order_reader.hpp"

#include <cstddef>

#include "firmware/core/big_endian.hpp"
#include "firmware/core/status.hpp"
#include "firmware/messages/dictionary/command_fields.hpp"
#include "firmware/wire/lcm/codec.hpp"

namespace earshot::wire {
namespace {

constexpr std::uint64_t kLatestDate_us = std::uint64_t{1} << 53U;  // 2255; most doubles, in a date's place, are far beyond

std::uint64_t number_at(std::span<const std::uint8_t> head, std::size_t offset, std::size_t size) {
  return load_big_endian(head.subspan(offset, size));
}

bool is_head(std::span<const std::uint8_t> head) {
  if (number_at(head, 0, 8) == lcm_fingerprint<messages::OperatorCommand>()) return true;
  const std::uint64_t order = head[32];
  return messages::is_value_of<messages::Order>(order) && number_at(head, 8, 8) <= kLatestDate_us &&
         number_at(head, 16, 8) <= kLatestDate_us;
}

messages::OperatorCommand command_in(std::span<const std::uint8_t> head) {
  return {.time = {static_cast<std::int64_t>(number_at(head, 8, 8))},
          .expiry = {static_cast<std::int64_t>(number_at(head, 16, 8))},
          .issuer = static_cast<std::uint32_t>(number_at(head, 24, 4)),
          .number = static_cast<std::uint32_t>(number_at(head, 28, 4)),
          .order = static_cast<messages::Order>(head[32])};
}

}  // namespace

ReadOrder read_order(std::span<const std::uint8_t> bytes) {
  messages::OperatorCommand whole;
  if (decode(bytes, whole) == Status::kOk) return {.form = OrderForm::kWhole, .command = whole};
  if (bytes.size() < kOrderHeadBytes) return {};
  const std::span<const std::uint8_t> head = bytes.first(kOrderHeadBytes);
  if (!is_head(head)) return {};
  ReadOrder read{.form = OrderForm::kUnreadable, .command = command_in(head)};
  if (read.command.order == messages::Order::kAbort) read.form = OrderForm::kAbort;
  return read;
}

}  // namespace earshot::wire
