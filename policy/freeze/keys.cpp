#include "policy/freeze/keys.hpp"

#include <sodium.h>

#include <span>

#include "firmware/host/toml/table_reader.hpp"

namespace earshot::freeze {
namespace {

using Key = std::array<std::uint8_t, 32>;
static_assert(crypto_sign_SEEDBYTES == 32 && crypto_sign_PUBLICKEYBYTES == 32);

std::string in_hex(std::span<const std::uint8_t> bytes) {
  std::string text(2 * bytes.size() + 1, '\0');
  sodium_bin2hex(text.data(), text.size(), bytes.data(), bytes.size());
  text.back() = '\n';
  return text;
}

Key from_hex(std::string_view text, const std::string& file, const std::string& kind) {
  ready_libsodium();
  Key key{};
  std::size_t read = 0;
  const char* end = nullptr;
  const bool digits = sodium_hex2bin(key.data(), key.size(), text.data(), text.size(), "\n", &read, &end) == 0;
  if (!digits || read != key.size() || end != text.data() + text.size()) {
    throw host::BadInput(file + ": not a " + kind + " key: must be one line of 64 hexadecimal digits");
  }
  return key;
}

}  // namespace

void ready_libsodium() {
  if (sodium_init() < 0) throw host::BadInput("libsodium finds no source of random numbers");
}

SecretKey make_key() {
  ready_libsodium();
  SecretKey key;
  randombytes_buf(key.seed.data(), key.seed.size());
  return key;
}

PublicKey public_key_of(const SecretKey& key) {
  ready_libsodium();
  PublicKey public_key{};
  std::array<std::uint8_t, crypto_sign_SECRETKEYBYTES> expanded{};
  crypto_sign_seed_keypair(public_key.data(), expanded.data(), key.seed.data());
  return public_key;
}

std::string to_text(const SecretKey& key) {
  return in_hex(key.seed);
}
std::string to_text(const PublicKey& key) {
  return in_hex(key);
}
SecretKey secret_key_from(std::string_view text, const std::string& file) {
  return {from_hex(text, file, "secret")};
}
PublicKey public_key_from(std::string_view text, const std::string& file) {
  return from_hex(text, file, "public");
}

}  // namespace earshot::freeze
