#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "firmware/wire/n2k/frame.hpp"
#include "firmware/wire/n2k/identifier.hpp"

namespace earshot::n2k {

/// A device's NAME: 64 bits that no other device has, whatever its address. The lower it is, the more rights to an address it has.
using Name = std::uint64_t;

/// The NAME in an address claim (60928), or nothing if it is too short to hold one.
[[nodiscard]] std::optional<Name> name_in(const Frame& claim);

/// Which device has which address, as address claims say.
class Directory {
 public:
  /// @param claim  a frame of 60928
  void accept(std::uint8_t source, const Frame& claim);

  /// Nothing if no device has claimed the address since this began to listen.
  [[nodiscard]] std::optional<Name> name_of(std::uint8_t address) const {
    const Name name = names_[address];
    return name == kNobody ? std::nullopt : std::optional(name);
  }

 private:
  static constexpr Name kNobody = 0;  ///< no NAME is zero: a device in the marine industry has bits set
  std::array<Name, 256> names_{};
};

}  // namespace earshot::n2k
