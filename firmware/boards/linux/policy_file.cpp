#include "firmware/boards/linux/policy_file.hpp"

#include <sodium.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <span>
#include <string>
#include <vector>

#include "firmware/config_file/table_reader.hpp"

namespace earshot::board {
namespace {

using config_file::BadInput;
using Bytes = std::vector<std::uint8_t>;
using PublicKey = std::array<std::uint8_t, policy::kPublicKeySize>;

Bytes read_file(const std::filesystem::path& path, std::size_t most) {
  std::error_code error;
  if (!std::filesystem::exists(path, error)) throw BadInput(path.string() + ": no such file");
  std::ifstream stream(path, std::ios::binary);
  if (!stream || std::filesystem::is_directory(path, error)) throw BadInput(path.string() + ": cannot be read");
  Bytes bytes(most + 1);
  stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  bytes.resize(static_cast<std::size_t>(stream.gcount()));
  if (bytes.size() > most) throw BadInput(path.string() + ": larger than such a file can be (" + std::to_string(most) + " bytes)");
  return bytes;
}

PublicKey load_public_key(const std::filesystem::path& path) {
  const Bytes text = read_file(path, 256);
  PublicKey key{};
  std::size_t size = 0;
  const char* rest = nullptr;
  const auto* const begin = reinterpret_cast<const char*>(text.data());
  const int result = sodium_hex2bin(key.data(), key.size(), begin, text.size(), "", &size, &rest);
  const bool only_space_follows = result == 0 && std::all_of(rest, begin + text.size(), [](char c) { return c == '\n' || c == ' '; });
  if (!only_space_follows || size != key.size())
    throw BadInput(path.string() + ": must hold a public key of 64 hexadecimal digits and nothing else");
  return key;
}

const char* in_words(policy::PolicyFault fault) {
  switch (fault) {
    case policy::PolicyFault::kNone:
      return "nothing is wrong";
    case policy::PolicyFault::kTooShort:
      return "is cut short";
    case policy::PolicyFault::kBadMagic:
      return "is not a .policy file";
    case policy::PolicyFault::kUnknownVersion:
      return "is of a later format than this program knows";
    case policy::PolicyFault::kBadChecksum:
      return "its CRC-32 is wrong: the file is damaged";
    case policy::PolicyFault::kBadShape:
      return "its shapes do not fit each other or exceed what the runtime holds (firmware/config/capacities.hpp)";
    case policy::PolicyFault::kUnknownActivation:
      return "has an activation this program does not know";
    case policy::PolicyFault::kUnknownFeature:
      return "observes a feature this program does not know";
    case policy::PolicyFault::kUnknownDraw:
      return "draws its actions in a way this program does not know";
    case policy::PolicyFault::kNotFinite:
      return "holds a weight, scale or direction that is not finite";
    case policy::PolicyFault::kGoldenMismatch:
      return "its network does not give its own golden logits on this machine";
  }
  return "is unreadable";
}

bool is_signed_by(const PublicKey& key, std::span<const std::uint8_t> bytes) {
  const std::span<const std::uint8_t> message = bytes.first(bytes.size() - policy::kSignatureSize);
  const std::span<const std::uint8_t> signature = bytes.last(policy::kSignatureSize);
  return crypto_sign_verify_detached(signature.data(), message.data(), message.size(), key.data()) == 0;
}

}  // namespace

std::unique_ptr<policy::FrozenPolicy> load_policy(const std::filesystem::path& path, const std::filesystem::path& public_key) {
  if (sodium_init() < 0) throw BadInput(path.string() + ": libsodium cannot start");
  const PublicKey key = load_public_key(public_key);
  const Bytes bytes = read_file(path, policy::max_serialised_size());
  auto parsed = std::make_unique<policy::FrozenPolicy>();
  policy::PolicyFault fault = policy::PolicyFault::kNone;
  // The file is taken apart before its signature is checked: parse() is built for hostile bytes, and "damaged" says more than "not signed".
  if (policy::parse(bytes, *parsed, fault) != Status::kOk) throw BadInput(path.string() + ": " + in_words(fault));
  if (!is_signed_by(key, bytes)) throw BadInput(path.string() + ": is not signed by the trusted key " + public_key.string());
  return parsed;
}

}  // namespace earshot::board
