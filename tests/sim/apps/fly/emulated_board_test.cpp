#include "sim/apps/fly/emulated_board.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "firmware/host/file/bad_input.hpp"
#include "tests/support/temporary_folder.hpp"

namespace earshot::fly {
namespace {

namespace fs = std::filesystem;

/// An emulator of a test: a script that is given what QEMU is.
fs::path emulator(const support::TemporaryFolder& folder, const std::string& script) {
  const fs::path path = folder / "emulator";
  std::ofstream(path) << "#!/bin/sh\n" << script;
  fs::permissions(path, fs::perms::owner_all);
  return path;
}

TEST(EmulatedBoard, HasItsLineAsLongAsItLives) {
  const support::TemporaryFolder folder;
  const fs::path script =
      emulator(folder, "echo \"$@\" > " + (folder / "told").string() +
                           "\nfor a; do case $a in socket,*) a=${a#*path=}; : > \"${a%%,*}\";; esac; done\nexec sleep 100\n");
  fs::path line;
  {
    const EmulatedBoard board("some.elf", 4711, script);
    line = board.line();
    EXPECT_TRUE(fs::exists(line));
  }
  EXPECT_FALSE(fs::exists(line));
  std::string told;
  std::getline(std::ifstream(folder / "told"), told);
  EXPECT_NE(told.find("-M mps2-an500"), std::string::npos) << told;
  EXPECT_NE(told.find("-kernel some.elf"), std::string::npos) << told;
}

TEST(EmulatedBoard, SaysThatAnEmulatorThatEndsDoesNotComeUp) {
  const support::TemporaryFolder folder;
  EXPECT_THROW(EmulatedBoard("some.elf", 4712, emulator(folder, "exit 1\n")), std::runtime_error);
}

TEST(EmulatedBoard, NamesWhatInstallsAnEmulatorThatIsNotThere) {
  try {
    const EmulatedBoard board("some.elf", 4713, "/nowhere/qemu-system-arm");
    FAIL();
  } catch (const host::BadInput& e) {
    EXPECT_STREQ(e.what(), "--board: there is no /nowhere/qemu-system-arm: toolchains/setup cortex-m7");
  }
}

}  // namespace
}  // namespace earshot::fly
