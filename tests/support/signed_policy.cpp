#include "tests/support/signed_policy.hpp"

#include <sodium.h>

#include <array>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <span>

#include "firmware/core/crc32.hpp"
#include "firmware/core/geometry.hpp"
#include "firmware/policy/format/policy_format.hpp"
#include "firmware/policy/tables/tables_format.hpp"
#include "tests/bits/eight_directions.hpp"

namespace earshot::support {
namespace {

struct KeyPair {
  std::array<std::uint8_t, crypto_sign_PUBLICKEYBYTES> open{};
  std::array<std::uint8_t, crypto_sign_SECRETKEYBYTES> secret{};
};

/// From a seed that anyone can read here: it is trusted by tests only.
KeyPair test_keys() {
  if (sodium_init() < 0) std::abort();
  std::array<std::uint8_t, crypto_sign_SEEDBYTES> seed{};
  seed.fill(7);
  KeyPair keys;
  crypto_sign_seed_keypair(keys.open.data(), keys.secret.data(), seed.data());
  return keys;
}

void record(policy::FrozenPolicy& policy) {
  policy::record_golden(policy, *std::make_unique<policy::SearchMemory>(), *std::make_unique<policy::OceanTables>());
}

}  // namespace

policy::FrozenPolicy random_walk_policy() {
  policy::FrozenPolicy policy;
  policy.observation.spec = policy::simple_state({Meters{25'000}, Meters{25'000}});
  for (const UnitNorthEast& direction : bits::kEightDirections) (void)policy.actions.push_back(direction);
  policy.step_length = Meters{1000};
  policy.area_size = {Meters{25'000}, Meters{25'000}};
  policy.detection_threshold = Decibels{10};
  policy.draw = policy::ActionDraw::kSampled;
  policy.network.observation_size = policy.observation.spec.size();
  policy.network.hidden_sizes = {8, 8};
  policy.network.action_count = bits::kEightDirections.size();
  record(policy);
  return policy;
}

void sign(std::vector<std::uint8_t>& bytes) {
  static const KeyPair keys = test_keys();
  const std::size_t message_size = bytes.size() - policy::kSignatureSize;
  crypto_sign_detached(bytes.data() + message_size, nullptr, bytes.data(), message_size, keys.secret.data());
}

std::vector<std::uint8_t> signed_bytes(const policy::FrozenPolicy& policy) {
  const auto recorded = std::make_unique<policy::FrozenPolicy>(policy);
  record(*recorded);
  std::vector<std::uint8_t> bytes(policy::max_serialised_size());
  const Result<std::size_t> size = policy::serialise(*recorded, test_keys().open, bytes);
  if (!size.ok()) std::abort();
  bytes.resize(size.value());
  sign(bytes);
  return bytes;
}

std::vector<std::uint8_t> signed_bytes(const policy::OceanTables& tables) {
  std::vector<std::uint8_t> bytes(policy::max_tables_size());
  const Result<std::size_t> size = policy::serialise(tables, test_keys().open, bytes);
  if (!size.ok()) std::abort();
  bytes.resize(size.value());
  sign(bytes);
  return bytes;
}

void mend(std::vector<std::uint8_t>& bytes) {
  const std::size_t covered = bytes.size() - policy::kSignatureSize - policy::format::kChecksumSize;
  const std::uint32_t checksum = crc32(std::span(bytes).first(covered));
  for (std::size_t i = 0; i < policy::format::kChecksumSize; ++i) bytes[covered + i] = static_cast<std::uint8_t>(checksum >> (8U * i));
  sign(bytes);
}

std::array<std::uint8_t, policy::kPublicKeySize> public_key() {
  return test_keys().open;
}

void write_public_key(const std::filesystem::path& path) {
  std::array<char, 2 * crypto_sign_PUBLICKEYBYTES + 1> text{};
  const KeyPair keys = test_keys();
  sodium_bin2hex(text.data(), text.size(), keys.open.data(), keys.open.size());
  std::ofstream(path) << text.data() << "\n";
}

void write_bytes(const std::filesystem::path& path, const std::vector<std::uint8_t>& bytes) {
  std::ofstream(path, std::ios::binary).write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
}

}  // namespace earshot::support
