#include "policy/evaluate/policy_file.hpp"

#include <cstdint>
#include <string>
#include <vector>

#include "firmware/host/file/input_file.hpp"
#include "firmware/host/toml/table_reader.hpp"

namespace earshot::evaluate {
namespace {

std::string in_words(policy::PolicyFault fault) {
  switch (fault) {
    case policy::PolicyFault::kNone:
      break;
    case policy::PolicyFault::kTooShort:
      return "cut short";
    case policy::PolicyFault::kBadMagic:
      return "not a .policy file";
    case policy::PolicyFault::kUnknownVersion:
      return "of another version of the format than this build's: freeze it again with earshot freeze";
    case policy::PolicyFault::kBadChecksum:
      return "damaged: its CRC-32 does not match";
    case policy::PolicyFault::kBadShape:
      return "of shapes that do not fit: a size is zero, too large or contradicts another";
    case policy::PolicyFault::kUnknownActivation:
      return "of an unknown activation; only tanh is known";
    case policy::PolicyFault::kUnknownFeature:
      return "made for an observation this build does not know";
    case policy::PolicyFault::kUnknownDraw:
      return "of an unknown way to draw actions; argmax and sampled are known";
    case policy::PolicyFault::kNotFinite:
      return "holding a weight, scale or direction that is no finite number";
    case policy::PolicyFault::kGoldenMismatch:
      return "not reproducing its golden logits on this machine";
  }
  return "refused";
}

}  // namespace

std::unique_ptr<policy::FrozenPolicy> load_policy(const std::filesystem::path& path) {
  const std::vector<std::uint8_t> bytes = host::read_bytes(path, {"a .policy file", policy::max_serialised_size()});
  auto policy = std::make_unique<policy::FrozenPolicy>();
  policy::PolicyFault fault = policy::PolicyFault::kNone;
  if (policy::parse(bytes, *policy, fault) != Status::kOk) throw host::BadInput(path.string() + ": policy is " + in_words(fault));
  return policy;
}

}  // namespace earshot::evaluate
