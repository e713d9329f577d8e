#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <string>

#include "firmware/host/policy/unverified_policy.hpp"
#include "firmware/host/trust/key_file.hpp"
#include "firmware/host/trust/signed_bytes.hpp"
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

TEST(ShippedPolicy, FindsTheFixedSourceOfThePapersOceanInNinetyNinePercentOfSearchesWithAMedianOfMinusThreeOrBetter) {
  const auto policy = host::load_unverified_policy(kShipped);
  const ocean::Environment environment = ocean::load_environment(EARSHOT_SOURCE_DIR "/sim/ocean/environments/munk_flat.toml");
  const sonar::SnrCurve curve = sonar::compute_snr_curve(environment, Meters{300.0}, Meters{37'000.0});
  search::SearchSettings settings = search_of(*policy);
  settings.source = environment.source.position;
  const Summary summary = summarise(evaluate(*policy, policy::OceanTables{}, policy->draw, world_of(*policy, settings, curve), 300, 2026));
  EXPECT_GE(summary.found_fraction, 0.99);
  EXPECT_GE(summary.median_reward, -3.0);
}

TEST(ShippedPolicy, IsSignedByTheShippedPublicKey) {
  const std::string bytes = bytes_of(kShipped);
  const std::string key_file = EARSHOT_SOURCE_DIR "/policy/frozen/earshot.pub";
  const std::vector<std::uint8_t> raw(bytes.begin(), bytes.end());
  EXPECT_TRUE(host::is_signed_at_end(raw, host::load_public_key(key_file).key));
}

}  // namespace
}  // namespace earshot::evaluate
