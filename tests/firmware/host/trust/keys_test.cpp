#include "firmware/host/trust/keys.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "firmware/host/file/bad_input.hpp"

namespace earshot::host {
namespace {

SecretKey secret_of(const std::string& digits) {
  return {.seed = key_from(digits, "rfc", "a secret key")};
}

TEST(Keys, FollowTheFirstTestVectorOfRfc8032) {
  const SecretKey key = secret_of("9d61b19deffd5a60ba844af492ec2cc44449c5697b326919703bac031cae7f60\n");
  EXPECT_EQ(to_text(public_key_of(key)), "d75a980182b10ab7d54bfed3c964073a0ee172f3daa62325af021a68f707511a\n");
}

// RFC 8032, 7.1, tests 1 and 3.
TEST(Keys, SignAsRfc8032Prints) {
  const SecretKey first = secret_of("9d61b19deffd5a60ba844af492ec2cc44449c5697b326919703bac031cae7f60");
  EXPECT_EQ(
      to_hex(sign({}, first)),
      "e5564300c360ac729086e2cc806e828a84877f1eb8e5d974d873e065224901555fb8821590a33bacc61e39701cf9b46bd25bf5f0595bbe24655141438e7a100b");
  const SecretKey third = secret_of("c5aa8df43f9f837bedb7442f31dcb7b166d38535076f094b85ce3a2e0b4458f7");
  const std::vector<std::uint8_t> message{0xaf, 0x82};
  EXPECT_EQ(
      to_hex(sign(message, third)),
      "6291d657deec24024827e69c3abe01a30ce548a284743a445e3680d7db5ac3ac18ff9b538d16f290ae67f760984dc6594a7c15e9716ed28dc027beceea1ec40a");
}

TEST(Keys, SignEveryBitOfAMessageForTheirOwnPublicHalfAlone) {
  const SecretKey key = make_key();
  std::vector<std::uint8_t> message(88, 0x5A);
  Signature signature = sign(message, key);
  EXPECT_TRUE(is_signed(message, signature, public_key_of(key)));
  EXPECT_FALSE(is_signed(message, signature, public_key_of(make_key())));
  for (std::uint8_t& byte : message) {
    byte ^= 1U;
    EXPECT_FALSE(is_signed(message, signature, public_key_of(key)));
    byte ^= 1U;
  }
  signature[0] ^= 1U;
  EXPECT_FALSE(is_signed(message, signature, public_key_of(key)));
}

TEST(Keys, SurviveTheirText) {
  const SecretKey key = make_key();
  EXPECT_EQ(secret_of(to_text(key)).seed, key.seed);
  EXPECT_EQ(key_from(to_text(public_key_of(key)), "k", "a public key"), public_key_of(key));
}

TEST(Keys, AreRefusedUnlessOneLineOfSixtyFourDigits) {
  const std::string whole = to_text(make_key());
  for (const std::string& bad : {std::string(), whole.substr(2), whole + "00", "g" + whole.substr(1), std::string(64, ' '),
                                 whole.substr(0, 32) + "\n" + whole.substr(32), std::string("no key")}) {
    EXPECT_THROW((void)key_from(bad, "k", "a secret key"), BadInput) << bad;
  }
}

// FIPS 180-2, appendix B.1.
TEST(Sha256Of, IsWhatFips180Prints) {
  EXPECT_EQ(to_hex(sha256_of(std::string_view("abc"))), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

}  // namespace
}  // namespace earshot::host
