#pragma once

#include <string>

#include "firmware/core/time.hpp"
#include "firmware/messages/operator_command.hpp"

namespace earshot::hil {

/// Somebody on the bus who is no device of the vehicle's gives Earshot an order, once, to be obeyed for half a minute.
/// @param utc  by the wall clock
/// @throws std::system_error as host::CanSocket does; std::runtime_error: the bus takes no frames
void give_order(const std::string& interface, messages::Order order, Time utc);

}  // namespace earshot::hil
