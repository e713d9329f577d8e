#include "firmware/host/file/shipped.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "firmware/host/file/bad_input.hpp"

namespace earshot::host {
namespace {

/// A test program stands in build/PRESET/tests, as deep below the source tree as one that ships.
TEST(Shipped, FindsAFileOfTheSourceTreeThatTheProgramWasBuiltIn) {
  EXPECT_TRUE(std::filesystem::equivalent(shipped("LICENSE"), std::filesystem::path(EARSHOT_SOURCE_DIR) / "LICENSE"));
}

TEST(Shipped, SaysWhereItLookedForWhatIsNotThere) {
  try {
    (void)shipped("sim/no_such.toml");
    FAIL();
  } catch (const BadInput& e) {
    const std::string folder = std::filesystem::canonical("/proc/self/exe").parent_path().string();
    EXPECT_EQ(std::string(e.what()),
              "sim/no_such.toml: is neither in the source tree that " + folder + " was built in, nor installed beside it");
  }
}

}  // namespace
}  // namespace earshot::host
