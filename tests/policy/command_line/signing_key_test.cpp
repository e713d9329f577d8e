#include "policy/command_line/signing_key.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/trust/key_file.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot::command_line {
namespace {

template <class Work>
std::string refusal(Work work) {
  try {
    work();
  } catch (const host::BadInput& bad) {
    return bad.what();
  }
  return "not refused";
}

class SigningKey : public testing::Test {
 protected:
  [[nodiscard]] SigningKeyOptions options() const { return {.key = folder_ / "a.key"}; }
  [[nodiscard]] SigningKeyOptions with_new_key() const {
    SigningKeyOptions o = options();
    o.new_key = true;
    return o;
  }

  const support::TemporaryFolder folder_;
  const std::string secret_ = folder_ / "a.key";
  const std::string public_ = folder_ / "a.pub";
};

TEST_F(SigningKey, IsMadeWhenItIsAskedForAndReadAfterwards) {
  EXPECT_EQ(refusal([&] { (void)options().read(false); }), secret_ + ": no such key; --new-key makes one");
  const host::SecretKey made = with_new_key().read(false);
  EXPECT_EQ(options().read(false).seed, made.seed);
  EXPECT_EQ(host::load_public_key(public_).key, host::public_key_of(made));
}

TEST_F(SigningKey, IsNeverReplacedNotEvenByForce) {
  (void)with_new_key().read(false);
  EXPECT_TRUE(
      support::tells(refusal([&] { (void)with_new_key().read(true); }), {secret_, "exists already", "never replaced", "--new-key"}));
}

TEST_F(SigningKey, BesideAnothersPublicHalfIsRefused) {
  (void)with_new_key().read(false);
  std::ofstream(public_) << std::string(64, 'a') << "\n";
  EXPECT_NE(refusal([&] { (void)options().read(false); }).find("is not the public half of"), std::string::npos);
}

TEST_F(SigningKey, GetsItsPublicHalfBackWhenThatIsAskedFor) {
  const host::SecretKey made = with_new_key().read(false);
  std::filesystem::remove(public_);
  (void)options().read(false);
  EXPECT_FALSE(std::filesystem::exists(public_));
  SigningKeyOptions o = options();
  o.public_key = true;
  (void)o.read(false);
  EXPECT_EQ(host::load_public_key(public_).key, host::public_key_of(made));
}

TEST_F(SigningKey, ReplacesALonePublicHalfByForceAlone) {
  (void)with_new_key().read(false);
  std::filesystem::remove(secret_);
  EXPECT_NE(refusal([&] { (void)with_new_key().read(false); }).find("--force replaces it"), std::string::npos);
  EXPECT_EQ(refusal([&] { (void)with_new_key().read(true); }), "not refused");
}

TEST_F(SigningKey, IsNotWhatIsWrittenNorItsPublicHalf) {
  const auto refused = [&](const std::filesystem::path& output) {
    return refusal([&] {
      host::DistinctFiles files;
      options().add_to(files);
      files.write("--output", output);
    });
  };
  EXPECT_EQ(refused(folder_ / "a.tables"), "not refused");
  EXPECT_TRUE(support::tells(refused(secret_), {"--key", secret_, "--output", secret_, "same file", "replace"}));
  EXPECT_TRUE(support::tells(refused(public_), {"public half", "--key", public_, "--output", public_, "same file", "replace"}));
}

}  // namespace
}  // namespace earshot::command_line
