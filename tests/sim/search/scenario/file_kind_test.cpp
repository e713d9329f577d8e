#include "sim/search/scenario/file_kind.hpp"

#include <gtest/gtest.h>

#include <string>

#include "firmware/host/file/bad_input.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot::search {
namespace {

const std::string kRoot = EARSHOT_SOURCE_DIR;

TEST(FileKind, IsToldByTheKeysOfAFile) {
  EXPECT_EQ(kind_of(kRoot + "/sim/ocean/environments/munk_flat.toml"), FileKind::kEnvironment);
  EXPECT_EQ(kind_of(kRoot + "/policy/worlds/rock.toml"), FileKind::kWorld);
  EXPECT_EQ(kind_of(kRoot + "/firmware/boards/linux/missions/search.toml"), FileKind::kMission);
  EXPECT_EQ(kind_of(kRoot + "/policy/ppo/runs/fixed_source.toml"), FileKind::kOther);
  EXPECT_EQ(kind_of(kRoot + "/README.md"), FileKind::kOther);
  EXPECT_EQ(kind_of(kRoot + "/none.toml"), FileKind::kOther);
}

TEST(FileKind, IsRefusedInOneLineWhereAnotherIsWantedAndLeftToTheReaderWhereItIsUnknown) {
  const host::TomlFile rock(kRoot + "/policy/worlds/rock.toml");
  EXPECT_NO_THROW(require_kind("--world", rock, FileKind::kWorld));
  EXPECT_NO_THROW(require_kind("--world", host::TomlFile("none.toml", "a = 1"), FileKind::kWorld));
  try {
    require_kind("--environment", rock, FileKind::kEnvironment);
    FAIL() << "a world is no environment";
  } catch (const host::BadInput& e) {
    EXPECT_TRUE(
        support::tells(std::string(e.what()), {"--environment", kRoot, "/policy/worlds/rock.toml", "--world", "not", "--environment"}));
  }
}

}  // namespace
}  // namespace earshot::search
