#pragma once

#include <string>

#include "firmware/policy/frozen_policy.hpp"

namespace earshot::command_line {

/// "network 64-64 tanh of 33312 bytes", which it takes in a vehicle's memory; or "no network".
[[nodiscard]] std::string network_text(const policy::Network& network);

/// Prints, with --verbose, what a policy sees and does, and its provenance line by line.
void print_policy_details(const std::string& name, const policy::FrozenPolicy& policy);

}  // namespace earshot::command_line
