#include "firmware/host/trust/key_file.hpp"

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

const std::string kDigits = "9d61b19deffd5a60ba844af492ec2cc44449c5697b326919703bac031cae7f60";

class SecretKeyFile : public testing::Test {
 protected:
  std::string complaint_with(mode_t mode) {
    std::ofstream(file_) << kDigits << "\n";
    EXPECT_EQ(::chmod(file_.c_str(), mode), 0);
    return complaint_of([this] { (void)read_signing_key(file_); });
  }

  const support::TemporaryFolder folder_;
  const std::filesystem::path file_ = folder_ / "ops.key";
};

TEST_F(SecretKeyFile, OfItsOwnerAloneIsRead) {
  EXPECT_EQ(complaint_with(0600), "");
  EXPECT_EQ(complaint_with(0400), "");
  EXPECT_EQ(to_hex(read_signing_key(file_).seed), kDigits);
}

TEST_F(SecretKeyFile, ThatOthersCanReadOrChangeIsRefusedWithTheChmodThatMendsIt) {
  for (const mode_t mode : {0640U, 0604U, 0620U, 0602U, 0644U, 0777U}) {
    const std::string said = complaint_with(mode);
    EXPECT_NE(said.find("chmod 600 " + file_.string()), std::string::npos) << std::oct << mode << ": " << said;
    EXPECT_EQ(said.find(kDigits), std::string::npos) << "a secret is told";
  }
  EXPECT_NE(complaint_with(0640).find("its mode 0640 lets others"), std::string::npos);
}

TEST_F(SecretKeyFile, IsJudgedWhereItsLinkLeads) {
  (void)complaint_with(0644);
  std::filesystem::create_symlink("ops.key", folder_ / "link.key");
  EXPECT_NE(complaint_of([this] { (void)read_signing_key(folder_ / "link.key"); }), "");
}

TEST_F(SecretKeyFile, IsRefusedWhereItIsNoRegularFileAndIsNotWaitedFor) {
  ASSERT_EQ(::mkfifo(file_.c_str(), 0600), 0);
  EXPECT_NE(complaint_of([this] { (void)read_signing_key(file_); }).find("it is a pipe"), std::string::npos);
  EXPECT_NE(complaint_of([] { (void)read_signing_key("/dev/null"); }).find("it is a device"), std::string::npos);
  EXPECT_NE(complaint_of([this] { (void)read_signing_key(folder_); }).find("it is a folder"), std::string::npos);
  EXPECT_NE(complaint_of([this] { (void)read_signing_key(folder_ / "none"); }).find("no such file"), std::string::npos);
}

TEST_F(SecretKeyFile, ThatHoldsNoKeyIsRefused) {
  std::ofstream(file_) << "swordfish\n";
  ::chmod(file_.c_str(), 0600);
  EXPECT_TRUE(support::tells(complaint_of([this] { (void)read_signing_key(file_); }),
                             {file_.string(), "hold", "secret", "64", "hexadecimal", "nothing"}));
}

TEST(PublicKeyFile, MayBeReadByAnybody) {
  const support::TemporaryFolder folder;
  std::ofstream(folder / "ops.pub") << kDigits << "\n";
  ::chmod((folder / "ops.pub").c_str(), 0644);
  EXPECT_EQ(to_hex(load_public_key(folder / "ops.pub").key), kDigits);
}

}  // namespace
}  // namespace earshot::host
