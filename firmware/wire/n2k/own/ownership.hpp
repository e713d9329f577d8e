#pragma once

#include <cstdint>
#include <span>

#include "firmware/wire/n2k/codec.hpp"
#include "firmware/wire/n2k/signals.hpp"

namespace earshot::n2k {

/// Whether bytes of a proprietary group are this message of ours: other makers send other things under the same numbers.
[[nodiscard]] constexpr bool is_ours(const Message& message, std::span<const std::uint8_t> bytes) {
  constexpr Signal kMaker = table::manufacturer();
  constexpr Signal kIndustry = table::industry();
  constexpr Signal kKind = table::message_kind();
  const auto holds = [bytes](const Signal& signal, std::int64_t expected) {
    const Result<std::int64_t> raw = decode_raw(signal, bytes);
    return raw.ok() && raw.value() == expected;
  };
  return holds(kMaker, table::kManufacturer) && holds(kIndustry, table::kMarineIndustry) &&
         (message.kind == 0 || holds(kKind, message.kind));
}

/// A message of ours with its head written.
[[nodiscard]] inline MessageWriter begin_own(const Message& message) {
  MessageWriter writer(message);
  writer.set_raw("ManufacturerCode", table::kManufacturer).set_raw("IndustryGroup", table::kMarineIndustry);
  if (message.kind != 0) writer.set_raw("Kind", message.kind);
  return writer;
}

}  // namespace earshot::n2k
