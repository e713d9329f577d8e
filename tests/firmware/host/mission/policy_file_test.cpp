#include "firmware/host/mission/policy_file.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <span>
#include <string>
#include <vector>

#include "firmware/core/crc32.hpp"
#include "firmware/host/toml/table_reader.hpp"
#include "tests/support/signed_policy.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot::host {
namespace {

constexpr const char* kHint = "; --public-key names the public half of the key that signed it";

class PolicyFile : public testing::Test {
 protected:
  void SetUp() override {
    support::write_public_key(key_ = folder_ / "key.pub");
    policy_ = folder_ / "walk.policy";
  }

  /// What load_policy says about these bytes; empty when it takes them.
  std::string complaint(const std::vector<std::uint8_t>& bytes) {
    support::write_bytes(policy_, bytes);
    return complaint();
  }
  std::string complaint() {
    try {
      (void)load_policy(policy_, key_);
      return "";
    } catch (const host::BadInput& e) {
      return e.what();
    }
  }

  const support::TemporaryFolder folder_;
  std::filesystem::path key_;
  std::filesystem::path policy_;
};

TEST_F(PolicyFile, IsTakenWhenItIsWholeAndSignedByTheTrustedKey) {
  support::write_bytes(policy_, support::signed_bytes(support::random_walk_policy()));
  EXPECT_EQ(load_policy(policy_, key_).policy->actions.size(), 8);
}

TEST_F(PolicyFile, IsRefusedAsMissingByName) {
  EXPECT_EQ(complaint(), policy_.string() + ": no such file");
}

TEST_F(PolicyFile, IsRefusedForItsChecksumWhenABitInTheMiddleIsFlipped) {
  std::vector<std::uint8_t> bytes = support::signed_bytes(support::random_walk_policy());
  bytes[bytes.size() / 2] ^= 1U;
  EXPECT_NE(complaint(bytes).find("is damaged: its CRC-32 is wrong"), std::string::npos) << complaint(bytes);
}

TEST_F(PolicyFile, IsRefusedWithTheProgramsLimitsWhenItIsTooLarge) {
  // Header 16, section's tag, version and length 10, activation 1, observation 1, hidden layers 4.
  constexpr std::size_t kActionCountAt = 32;
  std::vector<std::uint8_t> bytes = support::signed_bytes(support::random_walk_policy());
  bytes[kActionCountAt] = 33;
  const std::size_t checksum_at = bytes.size() - policy::kSignatureSize - 4;
  const std::uint32_t checksum = crc32(std::span(bytes).first(checksum_at));
  for (std::size_t i = 0; i < 4; ++i) bytes[checksum_at + i] = static_cast<std::uint8_t>(checksum >> (8U * i));
  support::sign(bytes);
  EXPECT_TRUE(support::has_line(complaint(bytes),
                                {"holds", "64 observations", "32 actions", "256 units", "3 hidden layers", "2500 cells", "1024 bytes"}))
      << complaint(bytes);
}

TEST_F(PolicyFile, IsRefusedWhenItsSignatureIsNotOfItsBytes) {
  std::vector<std::uint8_t> bytes = support::signed_bytes(support::random_walk_policy());
  bytes.back() ^= 1U;
  EXPECT_EQ(complaint(bytes), policy_.string() + ": is not signed by the trusted key " + key_.string() + kHint);
}

TEST_F(PolicyFile, IsRefusedWhenAnotherKeyIsTrusted) {
  std::ofstream(key_) << std::string(64, 'a') << "\n";
  EXPECT_EQ(complaint(support::signed_bytes(support::random_walk_policy())),
            policy_.string() + ": is not signed by the trusted key " + key_.string() + kHint);
}

TEST_F(PolicyFile, IsRefusedWhenItIsCutAnywhere) {
  const std::vector<std::uint8_t> whole = support::signed_bytes(support::random_walk_policy());
  for (std::size_t size = 0; size < whole.size(); size += 97) {
    EXPECT_NE(complaint({whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size)}), "") << "cut at " << size;
  }
}

/// What check_fits says of the random walk's policy and a mission for which it was trained but for `change`; empty when it fits.
template <class Change>
std::string mismatch_after(Change change) {
  config::Mission mission;
  mission.operating_area = {{Meters{-5'000}, Meters{0}}, {Meters{20'000}, Meters{25'000}}};
  mission.step_length = Meters{1'000};
  mission.detection_threshold = Decibels{10};
  change(mission);
  try {
    check_fits(support::random_walk_policy(), "walk.policy", mission, "m.toml");
    return "";
  } catch (const host::BadInput& e) {
    return e.what();
  }
}

TEST(CheckFits, NamesTheMissionsValueAndThePolicysWhereTheyDiffer) {
  EXPECT_EQ(mismatch_after([](auto&) {}), "");
  EXPECT_TRUE(support::tells(mismatch_after([](auto& mission) { mission.step_length = Meters{1'500.5}; }),
                             {"m.toml", "search.step_length_m", "1500.5", "1000", "walk.policy"}));
  EXPECT_TRUE(support::tells(mismatch_after([](auto& mission) { mission.step_length = Meters{1'500.123456789}; }),
                             {"m.toml", "search.step_length_m", "1500.123457", "1000", "walk.policy"}));
  EXPECT_TRUE(support::tells(mismatch_after([](auto& mission) { mission.operating_area.north_east.north = Meters{45'000}; }),
                             {"m.toml", "50000 m north", "25000 m east", "25000 m north", "25000 m east", "walk.policy", "--area-north-m",
                              "N", "--area-east-m", "E"}));
  EXPECT_TRUE(support::tells(mismatch_after([](auto& mission) { mission.detection_threshold = Decibels{12}; }),
                             {"m.toml", "search.detection_threshold_db", "12", "10", "walk.policy"}));
  EXPECT_TRUE(support::tells(mismatch_after([](auto& mission) {
                               mission.listening = {config::Listening::kLoudest, Duration::seconds(30)};
                             }),
                             {"m.toml", "search.listening", "loudest", "30 s", "newest", "walk.policy"}));
}

TEST_F(PolicyFile, NamesTheKeyFileWhenThatIsNotAKey) {
  std::ofstream(key_) << "12 34\n";
  EXPECT_TRUE(support::tells(complaint(support::signed_bytes(support::random_walk_policy())),
                             {key_.string(), "hold", "public", "64", "hexadecimal", "nothing"}));
}

}  // namespace
}  // namespace earshot::host
