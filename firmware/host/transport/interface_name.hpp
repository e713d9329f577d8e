#pragma once

#include <string_view>

namespace earshot::host {

/// The rule of Linux for the name of a network interface, worded as the end of a complaint: "CAN interface \"a/b\": " + this.
inline constexpr const char* kInterfaceNameRule =
    "must be 1 to 15 characters without '/', ':' and white space, and neither \".\" nor \"..\", as Linux names interfaces";

/// Whether an interface can have this name: one that cannot need not be waited for.
/// Source: Linux 6.1, net/core/dev.c, dev_valid_name(); its white space is ASCII's and byte 0xA0.
/// Oracle: InterfaceName.*
[[nodiscard]] bool is_interface_name(std::string_view name);

}  // namespace earshot::host
