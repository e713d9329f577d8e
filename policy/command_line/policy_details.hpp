#pragma once

#include <string>

#include "firmware/policy/frozen_policy.hpp"

namespace earshot::command_line {

/// Prints, with --verbose, what a policy sees and does, and its provenance line by line.
void print_policy_details(const std::string& name, const policy::FrozenPolicy& policy);

}  // namespace earshot::command_line
