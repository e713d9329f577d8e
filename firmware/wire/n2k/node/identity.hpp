#pragma once

#include <cstdint>
#include <string_view>

#include "firmware/core/status.hpp"
#include "firmware/wire/n2k/sensors/directory.hpp"

namespace earshot::n2k {

/// What a NAME is made of.
struct NameParts {
  std::uint32_t unique_number = 0;     ///< 21 bits: of one maker, no two devices have the same
  std::uint16_t manufacturer = 2044;   ///< 11 bits; see table/proprietary.hpp
  std::uint8_t device_instance = 0;    ///< lower three bits and upper five together
  std::uint8_t device_function = 150;  ///< of class 40: autopilot
  std::uint8_t device_class = 40;      ///< steering and control surfaces
  std::uint8_t system_instance = 0;    ///< 4 bits
};

/// The NAME of a device of the marine industry that can claim any address. kOutOfRange: a part does not fit its bits.
/// Source: SAE J1939-81, 4.1; bits as in table/management.hpp.   Oracle: Name tests on recorded claims; the peer test
[[nodiscard]] Result<Name> name_of(const NameParts& parts);

/// What product information (126996) says. At most 32 characters of printable ASCII each.
struct Product {
  std::uint16_t code = 0;
  std::string_view model = "Earshot";
  std::string_view software_version = "";
  std::string_view model_version = "";
  std::string_view serial = "";
  std::uint8_t load_equivalency = 0;  ///< units of 50 mA drawn from the bus; 0: none
};

/// What configuration information (126998) says. At most 70 characters of printable ASCII each.
struct Configuration {
  std::string_view installation_1 = "";
  std::string_view installation_2 = "";
  std::string_view manufacturer = "";
};

/// All texts live as long as the node.
struct Identity {
  Name name = 0;
  std::uint8_t preferred_address = 0x40;  ///< claimed first; 0 to 251
  Product product;
  Configuration configuration;
};

}  // namespace earshot::n2k
