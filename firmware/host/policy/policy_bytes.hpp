#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "firmware/policy/envelope/policy_fault.hpp"
#include "firmware/policy/frozen_policy.hpp"

namespace earshot::host {

/// The policy in the bytes of a `.policy` file: whole, of sizes and numbers that can fly, and repeating its golden trajectories here. Its
/// signature is not looked at: a desk may look at any policy.
/// @param path  what the message calls it
/// @throws BadInput in one line: the file, the section and what is wrong with it
[[nodiscard]] std::unique_ptr<policy::FrozenPolicy> policy_from(std::span<const std::uint8_t> bytes, const std::filesystem::path& path);

/// As above; bytes that are a policy, whether it repeats its golden trajectories or not: for who arms a Runtime with it, which flies them.
[[nodiscard]] std::unique_ptr<policy::FrozenPolicy> unproven_policy_from(std::span<const std::uint8_t> bytes,
                                                                         const std::filesystem::path& path);

/// @throws BadInput as above unless this program, on this machine, repeats the policy's golden trajectories.
void require_repeats_golden(const policy::FrozenPolicy& policy, const std::filesystem::path& path);

/// What a person reads of where a policy comes from must be UTF-8, "key = value" line by line; a vehicle does nothing with it.
/// @throws BadInput as above
void require_provenance(std::string_view provenance, const std::filesystem::path& path);

/// "section NETW " where a complaint is about one, as its sentence begins; else empty.
[[nodiscard]] std::string section_of(const policy::PolicyComplaint& complaint);

/// "PATH: section NETW is missing, or not in its place". Of an older version of the format: with the command that writes such a file again.
[[nodiscard]] std::string to_string(const policy::PolicyComplaint& complaint, const std::filesystem::path& path);

}  // namespace earshot::host
