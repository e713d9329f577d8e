#include "firmware/host/file/shipped.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "firmware/host/file/bad_input.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot::host {
namespace {

namespace fs = std::filesystem;

std::string why_not(const fs::path& relative, const fs::path& bin, const std::string& variable) {
  try {
    (void)shipped(relative, bin, variable);
    return "found";
  } catch (const BadInput& e) {
    return e.what();
  }
}

/// One file everywhere where it may be: an own folder, an installation, a source tree with a build in it.
class ShippedPlaces : public testing::Test {
 protected:
  ShippedPlaces() {
    for (const char* place : {"own", "usr/share/earshot", "tree"}) {
      fs::create_directories(folder_ / place / "sim");
      std::ofstream(folder_ / place / "sim/sea.toml") << place;
    }
    fs::create_directories(folder_ / "usr/bin");
    fs::create_directories(folder_ / "tree/build/dev/bin");
  }

  support::TemporaryFolder temporary_;
  fs::path folder_ = temporary_.path();
};

/// A test program stands in build/PRESET/tests, as deep below the source tree as one that ships.
TEST(Shipped, FindsAFileOfTheSourceTreeThatTheProgramWasBuiltIn) {
  EXPECT_TRUE(fs::equivalent(shipped("LICENSE"), fs::path(EARSHOT_SOURCE_DIR) / "LICENSE"));
}

TEST(Shipped, TakesTheFolderThatTheVariableNames) {
  setenv(kDataVariable, EARSHOT_SOURCE_DIR "/sim", 1);
  const fs::path found = shipped("fly");
  unsetenv(kDataVariable);
  EXPECT_EQ(found, EARSHOT_SOURCE_DIR "/sim/fly");
}

TEST_F(ShippedPlaces, TheVariableGoesBeforeTheInstallation) {
  EXPECT_EQ(shipped("sim/sea.toml", folder_ / "usr/bin", folder_ / "own"), folder_ / "own/sim/sea.toml");
}

TEST_F(ShippedPlaces, AnInstalledProgramTakesWhatIsInstalledBesideIt) {
  EXPECT_EQ(shipped("sim/sea.toml", folder_ / "usr/bin", ""), folder_ / "usr/share/earshot/sim/sea.toml");
}

TEST_F(ShippedPlaces, AProgramOfATreeTakesTheTrees) {
  EXPECT_EQ(shipped("sim/sea.toml", folder_ / "tree/build/dev/bin", ""), folder_ / "tree/sim/sea.toml");
}

TEST_F(ShippedPlaces, TheInstallationGoesBeforeTheTreeAroundIt) {
  fs::create_directories(folder_ / "tree/build/installed/bin");
  fs::create_directories(folder_ / "tree/build/installed/share/earshot/sim");
  fs::copy_file(folder_ / "tree/sim/sea.toml", folder_ / "tree/build/installed/share/earshot/sim/sea.toml");
  EXPECT_EQ(shipped("sim/sea.toml", folder_ / "tree/build/installed/bin", ""), folder_ / "tree/build/installed/share/earshot/sim/sea.toml");
}

TEST_F(ShippedPlaces, AFolderOfTheVariableWithoutTheFileIsRefusedThoughItIsInstalled) {
  fs::remove(folder_ / "own/sim/sea.toml");
  EXPECT_EQ(why_not("sim/sea.toml", folder_ / "usr/bin", folder_ / "own"),
            "sim/sea.toml: is not in " + (folder_ / "own").string() + ", the folder that EARSHOT_DATA names");
}

TEST_F(ShippedPlaces, WhatIsNowhereIsRefusedWithThePlacesThatWereSearched) {
  EXPECT_TRUE(support::tells(
      why_not("sim/no_such.toml", folder_ / "usr/bin", ""),
      {"sim/no_such.toml", "neither installed", "beside", (folder_ / "usr/bin").string(), "/share/earshot", "nor", "EARSHOT_DATA"}));
}

TEST(ShippedLibrary, ThatIsNowhereIsAnEmptyPath) {
  EXPECT_EQ(shipped_library("libearshot-none.so"), fs::path());
}

}  // namespace
}  // namespace earshot::host
