#include "firmware/host/policy/policy_bytes.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <functional>
#include <initializer_list>
#include <iterator>
#include <string>
#include <vector>

#include "firmware/core/crc32.hpp"
#include "firmware/host/toml/table_reader.hpp"
#include "firmware/policy/format/policy_format.hpp"
#include "tests/support/signed_policy.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot::host {
namespace {

using Bytes = std::vector<std::uint8_t>;

std::string complaint_about(const Bytes& bytes) {
  try {
    (void)policy_from(bytes, "a.policy");
    return "";
  } catch (const BadInput& e) {
    return e.what();
  }
}

/// What is said of the random walk after `damage`, its CRC-32 mended.
std::string complaint_after(const std::function<void(Bytes&)>& damage) {
  Bytes bytes = support::signed_bytes(support::random_walk_policy());
  damage(bytes);
  const std::size_t at = bytes.size() - policy::kSignatureSize - 4;
  const std::uint32_t crc = crc32(std::span(bytes).first(at));
  for (unsigned i = 0; i < 4; ++i) bytes[at + i] = static_cast<std::uint8_t>(crc >> (8U * i));
  return complaint_about(bytes);
}

TEST(PolicyBytes, AreAPolicyWhenWhole) {
  EXPECT_EQ(policy_from(support::signed_bytes(support::random_walk_policy()), "a.policy")->actions.size(), 8U);
}

TEST(PolicyBytes, AreRefusedWithTheSectionThatIsWrong) {
  constexpr std::size_t kNetworkAt = 16;
  EXPECT_TRUE(support::tells(complaint_after([](Bytes& bytes) { bytes[kNetworkAt] = 'X'; }), {"a.policy", "XETW", "not"}));
  EXPECT_TRUE(support::tells(complaint_after([](Bytes& bytes) { bytes[kNetworkAt] = 0x1B; }), {"a.policy", "\\x1bETW", "not know"}));
  EXPECT_TRUE(support::tells(complaint_after([](Bytes& bytes) { bytes[kNetworkAt + 4] = 7; }), {"a.policy", "NETW", "version 7", "not"}));
  EXPECT_TRUE(support::tells(complaint_after([](Bytes& bytes) { bytes[kNetworkAt + 6] ^= 1U; }), {"a.policy", "NETW", "not"}));
  EXPECT_EQ(complaint_about({}), "a.policy: is cut short");
}

/// The walk's network has 2 inputs, layers of 8 and 8 units and 8 actions; 65 288 units take 65 344 places, 8 take 64.
TEST(PolicyBytes, AreRefusedWithTheSizeOfANetworkThatIsTooLarge) {
  const std::string said = complaint_after([](Bytes& bytes) { bytes[29] = 0xFF; });
  const std::string size = std::to_string(4U * (65'344ULL * 3 + 64ULL * 65'289 + 8 * 9)) + " bytes";
  EXPECT_TRUE(support::tells(said, {"a.policy", "NETW", "larger network", size, "625792 bytes", "256 units"})) << said;
}

TEST(PolicyBytes, OfALaterVersionSaySo) {
  EXPECT_TRUE(support::tells(complaint_after([](Bytes& bytes) { bytes[8] = 5; }), {"a.policy", "version 5", "version 4", "later"}));
}

TEST(PolicyBytes, OfVersionsThatNothingReadsAreRefusedWithoutACommandThatWouldNotReadThemEither) {
  for (const std::uint8_t version : std::initializer_list<std::uint8_t>{0, 1, 2, 3})
    EXPECT_TRUE(support::tells(complaint_after([version](Bytes& bytes) { bytes[8] = version; }),
                               {"a.policy", "version", std::to_string(version), "version 4", "no", "any more", "anew", "MODEL", "a.policy",
                                "--force", "--key", "YOUR.key"}));
}

TEST(PolicyBytes, AreRefusedUnlessTheirProvenanceIsLinesOfText) {
  const auto complaint_with = [](const std::string& provenance) {
    policy::FrozenPolicy policy = support::random_walk_policy();
    policy.provenance.clear();
    for (const char c : provenance) (void)policy.provenance.push_back(c);
    return complaint_about(support::signed_bytes(policy));
  };
  for (const char* good : {"", "a = \n", "k\xC3\xBC = a\tb = c\n"}) EXPECT_EQ(complaint_with(good), "");
  EXPECT_TRUE(support::tells(complaint_with("a = \xff\n"), {"a.policy", "PROV", "not UTF-8"}));
  EXPECT_TRUE(support::tells(complaint_with("a = b\nc = d"), {"a.policy", "PROV", "within"}));
  for (const char* bad : {"\n", "a=b\n", " = b\n", "a\nb = c\n"})
    EXPECT_TRUE(support::tells(complaint_with(bad), {"a.policy", "PROV", "not", "key"})) << bad;
}

TEST(PolicyBytes, ThatAnotherBuildsArithmeticFrozeAreRefusedByAllButAFreezer) {
  policy::FrozenPolicy policy = support::random_walk_policy();
  policy.golden[1][2].logits[3] = 1e-9F;
  Bytes bytes(policy::max_serialised_size());
  const std::array<std::uint8_t, policy::kPublicKeySize> key{};
  bytes.resize(policy::serialise(policy, key, bytes).value());
  EXPECT_TRUE(support::tells(complaint_about(bytes), {"a.policy", "not", "machine", "differs"}));
  EXPECT_EQ(unproven_policy_from(bytes, "a.policy")->actions.size(), 8U);
}

}  // namespace
}  // namespace earshot::host
