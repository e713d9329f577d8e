#pragma once

#include <string>

namespace earshot::hil {

/// Takes a network interface up or down, as `ip link set` does. @throws std::system_error naming it; only root may
void switch_interface(const std::string& interface, bool up);

}  // namespace earshot::hil
