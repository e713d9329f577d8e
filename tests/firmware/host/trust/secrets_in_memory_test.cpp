// Whether a secret stands anywhere in this process's memory: what is kept of it here is its complement.

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "firmware/host/mission/authority/command_key.hpp"
#include "firmware/host/trust/key_file.hpp"
#include "firmware/host/trust/key_pair.hpp"
#include "firmware/host/trust/keys.hpp"
#include "tests/support/temporary_folder.hpp"

namespace earshot::host {
namespace {

using Complement = std::array<std::uint8_t, sizeof(KeyBytes)>;

Complement complement_of(const KeyBytes& key) {
  Complement complement;
  std::ranges::transform(key, complement.begin(), [](std::uint8_t byte) { return static_cast<std::uint8_t>(~byte); });
  return complement;
}

std::uint8_t digit_of(unsigned value) {
  return static_cast<std::uint8_t>(value < 10 ? '0' + value : 'a' + value - 10);
}

/// Memory that this process can write.
struct Region {
  const volatile std::uint8_t* begin;
  std::size_t size;
};

std::vector<Region> writable_memory() {
  std::vector<Region> regions;
  std::ifstream maps("/proc/self/maps");
  for (std::string line; std::getline(maps, line);) {
    std::uintptr_t begin = 0;
    std::uintptr_t end = 0;
    char dash = 0;
    std::string access;
    std::istringstream(line) >> std::hex >> begin >> dash >> end >> access;
    if (access.starts_with("rw")) regions.push_back({reinterpret_cast<const volatile std::uint8_t*>(begin), end - begin});
  }
  return regions;
}

/// How often the second half of the secret stands there, as bytes and as the digits of its text. (The first words of memory that the heap
/// has back are its own again.)
struct Found {
  std::size_t bytes = 0;
  std::size_t text = 0;
};

Found found(const Complement& complement, const std::vector<Region>& memory) {
  constexpr std::size_t kHalf = sizeof(KeyBytes) / 2;
  const volatile std::uint8_t* const kept = complement.data() + kHalf;  // byte by byte: no copy of the secret for its comparison
  const auto byte_at = [kept](std::size_t i) { return static_cast<std::uint8_t>(~kept[i]); };
  Found found;
  for (const Region& region : memory) {
    for (std::size_t at = 0; at + kHalf <= region.size; ++at) {
      const volatile std::uint8_t* const place = region.begin + at;
      std::size_t same = 0;
      while (same < kHalf && place[same] == byte_at(same)) ++same;
      if (same == kHalf) ++found.bytes;
      if (at + 2 * kHalf > region.size) continue;
      same = 0;
      while (same < kHalf && place[2 * same] == digit_of(byte_at(same) >> 4U) && place[2 * same + 1] == digit_of(byte_at(same) & 15U))
        ++same;
      if (same == kHalf) ++found.text;
    }
  }
  return found;
}

class SecretsInMemory : public testing::Test {
 protected:
  /// Another process makes the pair: what it leaves in memory goes with it.
  void SetUp() override {
    const pid_t child = ::fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
      (void)make_key_pair(file_, LonePublicHalf::kStays);
      ::_exit(0);
    }
    int status = 1;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    ASSERT_EQ(status, 0);
    // Once with another key: at a function's first call the dynamic linker lays registers on the stack, whatever is in them.
    const SecretKey other = make_key_pair(folder_ / "first.key", LonePublicHalf::kStays);
    use(read_signing_key(folder_ / "first.key"));
    use(CommandKey(folder_ / "first.key"));
  }

  static void use(const SecretKey& key) { EXPECT_TRUE(is_signed(key.seed, sign(key.seed, key), public_key_of(key))); }
  static void use(const CommandKey& key) {
    messages::OperatorCommand command{.time = Time{1}, .expiry = Time{2}, .issuer = 3, .number = 4};
    command.mark = key.mark_of(command, {});
    EXPECT_TRUE(key.verifies(command, {}));
  }

  /// @param memory  listed before the secret came into it: to list it covers what lies there
  static void expect_nowhere(const Complement& complement, const std::vector<Region>& memory) {
    for (const std::vector<Region>& regions : {memory, writable_memory()}) {
      const Found left = found(complement, regions);
      EXPECT_EQ(left.bytes, 0U);
      EXPECT_EQ(left.text, 0U);
    }
  }

  const support::TemporaryFolder folder_;
  const std::filesystem::path file_ = folder_ / "secret.key";
};

TEST_F(SecretsInMemory, OfASigningKeyAreGoneWithIt) {
  const std::vector<Region> memory = writable_memory();
  Complement complement;
  {
    const SecretKey key = read_signing_key(file_);
    complement = complement_of(key.seed);
    const Found kept = found(complement, memory);
    EXPECT_EQ(kept.bytes, 1U) << "itself";
    EXPECT_EQ(kept.text, 0U) << "of its file";
    use(key);
  }
  expect_nowhere(complement, memory);
}

TEST_F(SecretsInMemory, OfACommandKeyAreGoneWithItsLastCopy) {
  Complement complement;
  {
    const SecretKey key = read_signing_key(file_);
    complement = complement_of(key.seed);
  }
  const std::vector<Region> memory = writable_memory();
  std::optional<CommandKey> first(file_);
  EXPECT_EQ(found(complement, memory).bytes, 0U) << "it has pages of its own";
  std::optional<CommandKey> copy = first;
  use(*copy);
  first.reset();
  EXPECT_EQ(found(complement, writable_memory()).bytes, 1U) << "copies share one place";
  copy.reset();
  expect_nowhere(complement, memory);
}

TEST_F(SecretsInMemory, OfAKeyPairAreGoneWhenItIsWritten) {
  const std::vector<Region> memory = writable_memory();
  Complement complement;
  {
    const SecretKey key = make_key_pair(folder_ / "other.key", LonePublicHalf::kStays);
    complement = complement_of(key.seed);
    const Found kept = found(complement, memory);
    EXPECT_EQ(kept.bytes, 1U) << "itself";
    EXPECT_EQ(kept.text, 0U) << "of its file";
  }
  expect_nowhere(complement, memory);
}

}  // namespace
}  // namespace earshot::host
