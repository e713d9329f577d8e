#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "firmware/core/time.hpp"
#include "firmware/wire/n2k/frame.hpp"
#include "firmware/wire/n2k/identifier.hpp"
#include "firmware/wire/n2k/sensors/directory.hpp"

namespace earshot::n2k {

inline constexpr std::uint32_t kTransportControlPgn = 60416;
inline constexpr std::uint32_t kTransportDataPgn = 60160;

/// "The device with this NAME is to have this address" (65240).
struct AddressCommand {
  Name name = 0;  ///< without its spare bit and the one that says whether it can claim any address: commands leave them open
  std::uint8_t address = kNullAddress;
};

/// A NAME's bits that a commanded address is told by.
[[nodiscard]] constexpr Name commanded_bits(Name name) {
  return name & ~((Name{1} << 48U) | (Name{1} << 63U));
}

/// Puts the nine bytes of a commanded address together, which come by the transport protocol's broadcast: an announcement, two packets.
/// One at a time: a second announcement takes the place of the first.
/// Source: SAE J1939-21, 5.10; ISO 11783-3.   Oracle: CommandedAddress tests, bytes laid out by hand
class CommandedAddress {
 public:
  [[nodiscard]] std::optional<AddressCommand> accept(const Identifier& identifier, const Frame& frame, Time now);

 private:
  std::optional<std::uint8_t> sender_;  ///< of what is under way
  std::uint8_t next_ = 1;
  Time last_;
  std::array<std::uint8_t, 14> bytes_{};
};

}  // namespace earshot::n2k
