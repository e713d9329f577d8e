#include "firmware/host/trust/signature_file.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "tests/firmware/host/trust/complaint.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot::host {
namespace {

/// By the secret key of RFC 8032, 7.1, test 1, with Python's cryptography 48: Ed25519PrivateKey.from_private_bytes(...).sign(
/// b"EARSHOT MISSION1" + struct.pack("<Q", 258) + sha256(b"a mission\n").digest() + sha256(b"a policy\n").digest())
const std::string kText =
    "Earshot mission signature 1\n"
    "counter 258\n"
    "mission_sha256 879cf39c20fd722801faebd0d7d422baf59057129ba2886ef2240a1e27b78bc4\n"
    "policy_sha256 8f20683e4c9e991589cad8b12dbd690d94972e3638de384889ef7524abb0e11b\n"
    "public_key d75a980182b10ab7d54bfed3c964073a0ee172f3daa62325af021a68f707511a\n"
    "ed25519 "
    "65067e6ff92a5a0be8badc338e09fc777f15131d0087e6c9b3e911a82ad34cefead1d4d38a5c52e40c84980542411c3d6c516290e464c8e2a1f60af888232a00\n";

class SignatureFile : public testing::Test {
 protected:
  authority::SignedManifest read(const std::string& text) {
    std::ofstream(file_) << text;
    return read_signature(file_);
  }
  std::string complaint(const std::string& text) {
    return complaint_of([&] { (void)read(text); });
  }

  const support::TemporaryFolder folder_;
  const std::filesystem::path file_ = folder_ / "search.toml.sig";
};

TEST_F(SignatureFile, StandsBesideItsMission) {
  EXPECT_EQ(signature_file_of("missions/search.toml"), "missions/search.toml.sig");
}

TEST_F(SignatureFile, IsWhatPythonSigns) {
  const KeyBytes seed = key_from("9d61b19deffd5a60ba844af492ec2cc44449c5697b326919703bac031cae7f60", "rfc", "a secret key");
  const authority::MissionManifest manifest{
      .counter = 258, .mission = sha256_of(std::string_view("a mission\n")), .policy = sha256_of(std::string_view("a policy\n"))};
  EXPECT_EQ(to_text(sign(manifest, SecretKey{seed})), kText);
  EXPECT_TRUE(is_signed(read(kText)));
}

TEST_F(SignatureFile, DoesNotHoldForAnotherCounterHashOrKey) {
  for (const char* const name : {"counter ", "mission_sha256 ", "policy_sha256 ", "public_key ", "ed25519 "}) {
    std::string changed = kText;
    char& digit = changed[changed.find(name) + std::string(name).size()];
    digit = digit == '9' ? '7' : '9';
    EXPECT_FALSE(is_signed(read(changed))) << name;
  }
}

TEST_F(SignatureFile, CutAnywhereOrWithMoreBehindItIsRefused) {
  for (std::size_t size = 0; size < kText.size(); size += 7) EXPECT_NE(complaint(kText.substr(0, size)), "") << size;
  EXPECT_EQ(complaint(kText + "counter 9\n"), file_.string() + ":7: must be the end of the file");
  EXPECT_NE(complaint(kText + std::string(2000, 'x')).find("a mission's signature has at most 1024"), std::string::npos);
}

TEST_F(SignatureFile, OfALaterFormatIsRefused) {
  std::string later = kText;
  later.replace(later.find(" 1\n"), 3, " 2\n");
  EXPECT_TRUE(support::tells(complaint(later), {file_.string(), "1", "Earshot mission signature 1"}));
}

TEST_F(SignatureFile, ThatIsAPipeIsRefusedAndNotWaitedFor) {
  ASSERT_EQ(::mkfifo(file_.c_str(), 0600), 0);
  EXPECT_NE(complaint_of([this] { (void)read_signature(file_); }).find("it is a pipe"), std::string::npos);
}

}  // namespace
}  // namespace earshot::host
