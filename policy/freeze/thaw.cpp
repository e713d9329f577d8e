#include "policy/freeze/thaw.hpp"

#include "firmware/host/policy/policy_bytes.hpp"
#include "firmware/host/toml/table_reader.hpp"
#include "firmware/host/trust/signed_bytes.hpp"
#include "firmware/policy/format/policy_format.hpp"
#include "policy/freeze/freeze.hpp"
#include "policy/freeze/golden_search.hpp"

namespace earshot::freeze {
namespace {

using host::BadInput;

constexpr std::string_view kMagic = "EARSHOTP";

}  // namespace

bool is_policy(std::string_view bytes) {
  return bytes.starts_with(kMagic);
}

host::PublicKey signer_of(std::span<const std::uint8_t> bytes) {
  return policy::format::carried_key(bytes);
}

std::unique_ptr<policy::FrozenPolicy> thaw(std::span<const std::uint8_t> bytes, const std::string& file) {
  auto policy = host::unproven_policy_from(bytes, file);
  if (!host::is_signed_at_end(bytes, signer_of(bytes))) throw BadInput(file + ": its signature is not that of the key it carries");
  check_flies(*policy, file);
  fly_golden_searches(*policy);
  return policy;
}

}  // namespace earshot::freeze
