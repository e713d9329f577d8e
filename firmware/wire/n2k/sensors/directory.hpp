#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "firmware/config/capacities.hpp"
#include "firmware/wire/n2k/frame.hpp"
#include "firmware/wire/n2k/identifier.hpp"

namespace earshot::n2k {

/// A device's NAME: 64 bits that no other device has, whatever its address. The lower it is, the more rights to an address it has.
using Name = std::uint64_t;

/// The NAME in an address claim (60928), or nothing if it is too short to hold one.
[[nodiscard]] std::optional<Name> name_in(const Frame& claim);

/// Which device has which address, as address claims say: of kKnownDevices, those that claimed first.
class Directory {
 public:
  /// @param claim  a frame of 60928
  void accept(std::uint8_t source, const Frame& claim);

  /// Nothing if no device has claimed the address since this began to listen, or there was no room for its NAME.
  [[nodiscard]] std::optional<Name> name_of(std::uint8_t address) const {
    const std::size_t place = places_[address];
    return place == kNowhere ? std::nullopt : std::optional(names_[place - 1]);
  }
  /// Claims of devices for which there was no room.
  [[nodiscard]] std::uint64_t unknown() const { return unknown_; }

 private:
  static constexpr Name kNobody = 0;  ///< no NAME is zero: a device in the marine industry has bits set
  static constexpr std::uint8_t kNowhere = 0;

  void forget(std::uint8_t address);

  std::array<Name, config::kKnownDevices> names_{};  ///< kNobody: free
  std::array<std::uint8_t, 256> places_{};           ///< by address, one more than the index of its NAME, or kNowhere
  std::uint64_t unknown_ = 0;
  static_assert(config::kKnownDevices < 255, "a byte of places_ holds one more than any index");
};

}  // namespace earshot::n2k
