#include "firmware/host/trust/key_pair.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "firmware/host/trust/key_file.hpp"
#include "tests/firmware/host/trust/complaint.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot::host {
namespace {

namespace fs = std::filesystem;

class KeyPair : public testing::Test {
 protected:
  std::string complaint(LonePublicHalf lone = LonePublicHalf::kStays) {
    return complaint_of([&] { (void)make_key_pair(secret_, lone); });
  }

  const support::TemporaryFolder folder_;
  const fs::path secret_ = folder_ / "ops.key";
  const fs::path public_ = folder_ / "ops.pub";
};

TEST_F(KeyPair, IsTwoFilesOfWhichTheSecretOneIsItsOwnersAlone) {
  ASSERT_EQ(complaint(), "");
  EXPECT_EQ(fs::status(secret_).permissions(), fs::perms::owner_read | fs::perms::owner_write);
  EXPECT_EQ(load_public_key(public_).key, public_key_of(read_signing_key(secret_)));
  EXPECT_EQ(complaint_of([this] { require_public_half(read_signing_key(secret_), secret_); }), "");
}

TEST_F(KeyPair, NeverReplacesASecretKey) {
  ASSERT_EQ(complaint(), "");
  const KeyBytes seed = read_signing_key(secret_).seed;
  EXPECT_TRUE(support::tells(complaint(), {secret_.string(), "exists already", "never replaced", "name"}));
  EXPECT_TRUE(support::tells(complaint_of([this] { (void)make_key_pair(secret_, LonePublicHalf::kReplaced, {.secret = "sign with it"}); }),
                             {secret_.string(), "exists already", "never replaced", "sign"}));
  EXPECT_EQ(read_signing_key(secret_).seed, seed);
}

TEST_F(KeyPair, LeavesAPublicHalfWhoseSecretOneIsElsewhereUnlessToldToReplaceIt) {
  ASSERT_EQ(complaint(), "");
  fs::remove(secret_);
  const PublicKey lone = load_public_key(public_).key;
  EXPECT_TRUE(support::tells(complaint(), {public_.string(), "public half", "not", "vehicle", "trust"}));
  EXPECT_EQ(load_public_key(public_).key, lone);
  EXPECT_FALSE(fs::exists(secret_));
  EXPECT_EQ(complaint(LonePublicHalf::kReplaced), "");
  EXPECT_NE(load_public_key(public_).key, lone);
}

TEST_F(KeyPair, NeverReplacesWhatIsNoPublicKey) {
  std::ofstream(public_) << "notes of mine\n";
  EXPECT_NE(complaint(LonePublicHalf::kReplaced), "");
  EXPECT_FALSE(fs::exists(secret_));
}

TEST_F(KeyPair, RefusesASecretKeyThatIsNamedLikeAPublicOne) {
  EXPECT_NE(complaint_of([this] { (void)make_key_pair(public_, LonePublicHalf::kStays); }).find("must not end in .pub"), std::string::npos);
}

TEST_F(KeyPair, TellsThePublicHalfOfAnotherKey) {
  ASSERT_EQ(complaint(), "");
  EXPECT_NE(complaint_of([this] { require_public_half(make_key(), secret_); }).find("is not the public half"), std::string::npos);
}

TEST_F(KeyPair, OfSeveralProgramsThatMakeItAtOnceIsOnesAndWhole) {
  std::array<pid_t, 8> children{};
  for (pid_t& child : children) {
    child = ::fork();
    if (child == 0) std::_Exit(complaint().empty() ? 0 : 1);
  }
  int made = 0;
  for (const pid_t child : children) {
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    made += WEXITSTATUS(status) == 0 ? 1 : 0;
  }
  EXPECT_EQ(made, 1);
  EXPECT_EQ(load_public_key(public_).key, public_key_of(read_signing_key(secret_)));
}

}  // namespace
}  // namespace earshot::host
