#include "firmware/host/trust/signed_bytes.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "tests/firmware/host/trust/complaint.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot::host {
namespace {

std::vector<std::uint8_t> some_bytes() {
  std::vector<std::uint8_t> bytes(100);
  std::iota(bytes.begin(), bytes.end(), std::uint8_t{0});
  return bytes;
}

TEST(SignedBytes, HoldTheSignatureOfWhatStandsBeforeItAndNothingElseChanges) {
  const SecretKey key = make_key();
  std::vector<std::uint8_t> bytes = some_bytes();
  sign_at_end(bytes, key);
  const std::span<const std::uint8_t> all(bytes);
  EXPECT_TRUE(is_signed(all.first(36), all.last<64>(), public_key_of(key)));
  const std::vector<std::uint8_t> before = some_bytes();
  EXPECT_TRUE(std::equal(before.begin(), before.begin() + 36, bytes.begin()));
}

TEST(SignedBytes, AreSignedByOneKeyAndWithoutAnyChange) {
  const SecretKey key = make_key();
  std::vector<std::uint8_t> bytes = some_bytes();
  sign_at_end(bytes, key);
  EXPECT_TRUE(is_signed_at_end(bytes, public_key_of(key)));
  EXPECT_FALSE(is_signed_at_end(bytes, public_key_of(make_key())));
  for (std::uint8_t& byte : bytes) {
    byte ^= 1U;
    EXPECT_FALSE(is_signed_at_end(bytes, public_key_of(key))) << int{byte};
    byte ^= 1U;
  }
}

TEST(SignedBytes, ThatAreShorterThanASignatureAreNotSigned) {
  const std::vector<std::uint8_t> bytes(63);
  EXPECT_FALSE(is_signed_at_end(bytes, public_key_of(make_key())));
}

TEST(SignedBytes, NameTheTrustedKeyThatDidNotSign) {
  const SecretKey key = make_key();
  std::vector<std::uint8_t> bytes = some_bytes();
  sign_at_end(bytes, key);
  const TrustedKey signer{.key = public_key_of(key), .file = "mine.pub"};
  const TrustedKey other{.key = public_key_of(make_key()), .file = "other.pub"};
  EXPECT_NO_THROW(require_signed_by(bytes, "a.policy", signer));
  EXPECT_TRUE(support::tells(complaint_of([&] { require_signed_by(bytes, "a.policy", other); }),
                             {"a.policy", "not signed", "other.pub", "--public-key", "public", "signed"}));
  EXPECT_EQ(signer_of(bytes, "a.policy", {other, signer}, "v.toml"), "mine.pub");
  EXPECT_TRUE(support::tells(complaint_of([&] { (void)signer_of(bytes, "a.policy", {other}, "v.toml"); }),
                             {"a.policy", "signed", "none", "v.toml", "other.pub"}));
}

}  // namespace
}  // namespace earshot::host
