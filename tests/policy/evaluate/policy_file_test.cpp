#include "policy/evaluate/policy_file.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <string>

#include "firmware/host/toml/table_reader.hpp"
#include "policy/evaluate/evaluation.hpp"
#include "policy/freeze/freeze.hpp"
#include "sim/ocean/file/environment_file.hpp"
#include "sim/sonar/sonar_field.hpp"

namespace earshot::evaluate {
namespace {

const std::string kShipped = EARSHOT_SOURCE_DIR "/policy/frozen/fixed_source.policy";

std::string bytes_of(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

std::string fault_of(const std::string& bytes) {
  const std::string path = testing::TempDir() + "faulty.policy";
  std::ofstream(path, std::ios::binary) << bytes;
  try {
    (void)load_policy(path);
  } catch (const host::BadInput& e) {
    return e.what();
  }
  return "accepted";
}

TEST(PolicyFile, SaysInOneLineWhatIsWrong) {
  const std::string whole = bytes_of(kShipped);
  std::string flipped = whole;
  flipped[whole.size() / 2] = static_cast<char>(flipped[whole.size() / 2] ^ 1);
  std::string alien = whole;
  alien[0] = 'X';
  EXPECT_EQ(fault_of(flipped), testing::TempDir() + "faulty.policy: is damaged: its CRC-32 is wrong");
  EXPECT_EQ(fault_of(alien), testing::TempDir() + "faulty.policy: is not a .policy file");
  EXPECT_EQ(fault_of(whole.substr(0, whole.size() - 1)), testing::TempDir() + "faulty.policy: is cut short");
  EXPECT_EQ(fault_of(whole), "accepted");
}

TEST(PolicyFile, NamesAMissingFile) {
  try {
    (void)load_policy("/nowhere/a.policy");
    FAIL();
  } catch (const host::BadInput& e) {
    EXPECT_STREQ(e.what(), "/nowhere/a.policy: no such file");
  }
}

TEST(ShippedPolicy, FindsTheFixedSourceOfThePapersOceanInNinetyNinePercentOfSearchesWithAMedianOfMinusThreeOrBetter) {
  const auto policy = load_policy(kShipped);
  const ocean::Environment environment = ocean::load_environment(EARSHOT_SOURCE_DIR "/sim/ocean/environments/munk_flat.toml");
  const sonar::SnrCurve curve = sonar::compute_snr_curve(environment, Meters{300.0}, Meters{37'000.0});
  search::SearchSettings settings = search_of(*policy);
  settings.source = environment.source.position;
  const Summary summary = summarise(evaluate(*policy, policy->draw, world_of(*policy, settings, curve), 300, 2026));
  EXPECT_GE(summary.found_fraction, 0.99);
  EXPECT_GE(summary.median_reward, -3.0);
}

TEST(ShippedPolicy, IsSignedByTheShippedPublicKey) {
  const std::string bytes = bytes_of(kShipped);
  const std::string key_file = EARSHOT_SOURCE_DIR "/policy/frozen/earshot.pub";
  const std::vector<std::uint8_t> raw(bytes.begin(), bytes.end());
  EXPECT_TRUE(freeze::is_signed_by(raw, freeze::public_key_from(bytes_of(key_file), key_file)));
}

}  // namespace
}  // namespace earshot::evaluate
