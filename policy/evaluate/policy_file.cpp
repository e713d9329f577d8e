#include "policy/evaluate/policy_file.hpp"

#include <cstdint>
#include <vector>

#include "firmware/host/file/input_file.hpp"
#include "firmware/host/policy/policy_bytes.hpp"
#include "firmware/policy/format/policy_format.hpp"

namespace earshot::evaluate {

std::unique_ptr<policy::FrozenPolicy> load_policy(const std::filesystem::path& path) {
  const std::vector<std::uint8_t> bytes = host::read_bytes(path, {"a .policy file", policy::max_serialised_size()});
  return host::policy_from(bytes, path);
}

}  // namespace earshot::evaluate
