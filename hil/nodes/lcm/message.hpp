#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace earshot::hil {

/// A message on an LCM bus.
struct LcmMessage {
  std::string channel;
  std::vector<std::uint8_t> data;
  friend bool operator==(const LcmMessage&, const LcmMessage&) = default;
};

/// In this order.
using LcmMessages = std::vector<LcmMessage>;

}  // namespace earshot::hil
