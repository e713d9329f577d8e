#include "firmware/host/policy/unverified_policy.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <string>

#include "firmware/host/file/bad_input.hpp"
#include "tests/support/temporary_folder.hpp"

namespace earshot::host {
namespace {

const std::string kShipped = EARSHOT_SOURCE_DIR "/policy/frozen/fixed_source.policy";

std::string bytes_of(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

/// What load_unverified_policy says of a file with these bytes, without the file's name.
std::string fault_of(const std::string& bytes) {
  const support::TemporaryFolder folder;
  const std::string path = folder / "faulty.policy";
  std::ofstream(path, std::ios::binary) << bytes;
  try {
    (void)load_unverified_policy(path);
  } catch (const BadInput& e) {
    EXPECT_TRUE(std::string(e.what()).starts_with(path + ": ")) << e.what();
    return std::string(e.what()).substr(path.size() + 2);
  }
  return "accepted";
}

TEST(UnverifiedPolicy, SaysInOneLineWhatIsWrong) {
  const std::string whole = bytes_of(kShipped);
  std::string flipped = whole;
  flipped[whole.size() / 2] = static_cast<char>(flipped[whole.size() / 2] ^ 1);
  std::string alien = whole;
  alien[0] = 'X';
  EXPECT_EQ(fault_of(flipped), "is damaged: its CRC-32 is wrong");
  EXPECT_EQ(fault_of(alien), "is not a .policy file");
  EXPECT_EQ(fault_of(whole.substr(0, whole.size() - 1)), "is cut short");
  EXPECT_EQ(fault_of(whole), "accepted");
}

TEST(UnverifiedPolicy, NamesAMissingFile) {
  try {
    (void)load_unverified_policy("/nowhere/a.policy");
    FAIL();
  } catch (const BadInput& e) {
    EXPECT_STREQ(e.what(), "/nowhere/a.policy: no such file");
  }
}

}  // namespace
}  // namespace earshot::host
