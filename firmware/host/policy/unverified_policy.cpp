#include "firmware/host/policy/unverified_policy.hpp"

#include <cstdint>
#include <vector>

#include "firmware/host/file/input_file.hpp"
#include "firmware/host/policy/policy_bytes.hpp"
#include "firmware/policy/format/policy_format.hpp"

namespace earshot::host {

std::unique_ptr<policy::FrozenPolicy> load_unverified_policy(const std::filesystem::path& path) {
  const std::vector<std::uint8_t> bytes = read_bytes(path, {"a .policy file", policy::max_serialised_size()});
  return policy_from(bytes, path);
}

}  // namespace earshot::host
