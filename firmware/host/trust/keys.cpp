#include "firmware/host/trust/keys.hpp"

#include <sodium.h>
#include <sys/prctl.h>

#include "firmware/host/file/bad_input.hpp"

namespace earshot::host {
namespace {

static_assert(crypto_sign_SEEDBYTES == sizeof(KeyBytes) && crypto_sign_PUBLICKEYBYTES == sizeof(PublicKey) &&
              crypto_sign_BYTES == sizeof(Signature) && crypto_hash_sha256_BYTES == sizeof(authority::Sha256));

/// As libsodium signs with it: the seed and the public half.
struct ExpandedKey {
  PublicKey public_half{};
  std::array<std::uint8_t, crypto_sign_SECRETKEYBYTES> bytes{};

  explicit ExpandedKey(const SecretKey& key) {
    ready_libsodium();
    crypto_sign_seed_keypair(public_half.data(), bytes.data(), key.seed.data());
  }
  ~ExpandedKey() { wipe(bytes); }
  ExpandedKey(const ExpandedKey&) = delete;
  ExpandedKey& operator=(const ExpandedKey&) = delete;
};

}  // namespace

void wipe(std::span<std::uint8_t> bytes) {
  sodium_memzero(bytes.data(), bytes.size());
}

void guard_memory() {
  (void)::prctl(PR_SET_DUMPABLE, 0, 0, 0, 0);  // fails for values only
}

void ready_libsodium() {
  if (sodium_init() < 0) throw BadInput("libsodium finds no source of random numbers");
}

SecretKey make_key() {
  ready_libsodium();
  guard_memory();
  SecretKey key;
  randombytes_buf(key.seed.data(), key.seed.size());
  return key;
}

PublicKey public_key_of(const SecretKey& key) {
  return ExpandedKey(key).public_half;
}

Signature sign(std::span<const std::uint8_t> message, const SecretKey& key) {
  Signature signature{};
  crypto_sign_detached(signature.data(), nullptr, message.data(), message.size(), ExpandedKey(key).bytes.data());
  return signature;
}

bool is_signed(std::span<const std::uint8_t> message, std::span<const std::uint8_t, 64> signature, const PublicKey& key) {
  ready_libsodium();
  return crypto_sign_verify_detached(signature.data(), message.data(), message.size(), key.data()) == 0;
}

authority::Sha256 sha256_of(std::span<const std::uint8_t> bytes) {
  authority::Sha256 hash{};
  crypto_hash_sha256(hash.data(), bytes.data(), bytes.size());
  return hash;
}

authority::Sha256 sha256_of(std::string_view text) {
  return sha256_of(std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
}

std::string to_hex(std::span<const std::uint8_t> bytes) {
  std::string text(2 * bytes.size() + 1, '\0');
  sodium_bin2hex(text.data(), text.size(), bytes.data(), bytes.size());
  text.pop_back();
  return text;
}

bool from_hex(std::string_view text, std::span<std::uint8_t> bytes) {
  std::size_t size = 0;
  const char* end = nullptr;
  const int result = sodium_hex2bin(bytes.data(), bytes.size(), text.data(), text.size(), nullptr, &size, &end);
  return result == 0 && size == bytes.size() && end == text.data() + text.size();
}

std::string to_text(const SecretKey& key) {
  return to_hex(key.seed) + "\n";
}
std::string to_text(const PublicKey& key) {
  return to_hex(key) + "\n";
}

void read_key(std::string_view text, const std::filesystem::path& file, const char* kind, KeyBytes& key) {
  const std::size_t digits = text.find_last_not_of("\n\r ") + 1;  // nothing but space: npos + 1, which is 0
  if (!from_hex(text.substr(0, digits), key))
    throw BadInput(file.string() + ": must hold " + kind + " of 64 hexadecimal digits and nothing else");
}

KeyBytes key_from(std::string_view text, const std::filesystem::path& file, const char* kind) {
  KeyBytes key{};
  read_key(text, file, kind, key);
  return key;
}

}  // namespace earshot::host
