#include "firmware/host/mission/authority/command_key.hpp"

#include <sodium.h>

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <new>
#include <span>
#include <string_view>

namespace earshot::host {
namespace {

using messages::CommandMark;

constexpr std::uint64_t kNotGiven = 0x7ff8'0000'0000'0000U;
constexpr std::string_view kOrderDomain = "EARSHOT ORDER2";
constexpr std::string_view kChallengeDomain = "EARSHOT CHALLENGE1";

/// What is marked, byte by byte.
class MarkedBytes {
 public:
  MarkedBytes& text(std::string_view text) {
    for (const char c : text) bytes_[size_++] = static_cast<std::uint8_t>(c);
    return *this;
  }
  MarkedBytes& number(std::uint64_t value, unsigned bytes) {
    for (unsigned i = 0; i < bytes; ++i) bytes_[size_++] = static_cast<std::uint8_t>(value >> (8U * i));
    return *this;
  }
  MarkedBytes& challenge(const messages::Challenge& challenge) {
    return append(challenge.nonce).append(challenge.vehicle).append(challenge.mission);
  }
  MarkedBytes& order(const messages::OperatorCommand& command) {
    const messages::OperatorLimits& limits = command.limits;
    return number(static_cast<std::uint64_t>(command.time.us), 8)
        .number(static_cast<std::uint64_t>(command.expiry.us), 8)
        .number(command.issuer, 4)
        .number(command.number, 4)
        .number(static_cast<std::uint64_t>(command.order), 1)
        .number(limits.max_depth ? std::bit_cast<std::uint64_t>(limits.max_depth->value) : kNotGiven, 8)
        .number(limits.max_speed ? std::bit_cast<std::uint64_t>(limits.max_speed->value) : kNotGiven, 8)
        .number(limits.max_time_s ? std::bit_cast<std::uint64_t>(*limits.max_time_s) : kNotGiven, 8);
  }
  [[nodiscard]] CommandMark mark(const KeyBytes& key) const {
    static_assert(sizeof(CommandMark) == crypto_generichash_BYTES_MIN);
    static_assert(sizeof(KeyBytes) == crypto_generichash_KEYBYTES);
    CommandMark mark{};
    (void)crypto_generichash(mark.data(), mark.size(), bytes_.data(), size_, key.data(), key.size());  // fails for sizes only
    return mark;
  }

 private:
  MarkedBytes& append(std::span<const std::uint8_t> bytes) {
    for (const std::uint8_t byte : bytes) bytes_[size_++] = byte;
    return *this;
  }

  std::array<std::uint8_t, 143> bytes_{};  // an order's, which are the most
  std::size_t size_ = 0;
};

bool is_same(const CommandMark& a, const CommandMark& b) {
  return sodium_memcmp(a.data(), b.data(), a.size()) == 0;
}

/// Between pages that nobody may touch, and locked in memory where the system allows it; wiped when it goes.
std::shared_ptr<const KeyBytes> kept(const KeyBytes& key) {
  ready_libsodium();
  void* const place = sodium_malloc(sizeof(KeyBytes));
  if (place == nullptr) throw std::bad_alloc();
  return {new (place) KeyBytes(key), [](const KeyBytes* bytes) { sodium_free(const_cast<KeyBytes*>(bytes)); }};
}

}  // namespace

CommandKey::CommandKey(const KeyBytes& key) : key_(kept(key)) {}

CommandKey::CommandKey(const std::filesystem::path& file) : key_(kept(read_secret_key_file(file, "a command key").seed)) {}

CommandMark CommandKey::mark_of(const messages::OperatorCommand& command, const messages::Challenge& challenge) const {
  return MarkedBytes().text(kOrderDomain).challenge(challenge).order(command).mark(*key_);
}

CommandMark CommandKey::old_mark_of(const messages::OperatorCommand& command) const {
  return MarkedBytes().order(command).mark(*key_);
}

CommandMark CommandKey::mark_of(const messages::Challenge& challenge, Time published) const {
  return MarkedBytes().text(kChallengeDomain).number(static_cast<std::uint64_t>(published.us), 8).challenge(challenge).mark(*key_);
}

bool CommandKey::verifies(const messages::OperatorCommand& command, const messages::Challenge& challenge) const {
  return is_same(mark_of(command, challenge), command.mark);
}

bool CommandKey::verifies_old(const messages::OperatorCommand& command) const {
  return is_same(old_mark_of(command), command.mark);
}

bool CommandKey::verifies(const messages::PublishedChallenge& published) const {
  return is_same(mark_of(published.challenge, published.time), published.mark);
}

}  // namespace earshot::host
