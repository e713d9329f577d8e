#pragma once

#include <cstdint>

#include "firmware/core/time.hpp"

namespace earshot {

constexpr Time at_s(std::int64_t seconds) {
  return Time{} + Duration::seconds(seconds);
}

}  // namespace earshot
