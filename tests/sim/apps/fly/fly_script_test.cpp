// sim/fly: the script before the programs.

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <regex>
#include <string>
#include <vector>

#include "tests/support/process.hpp"
#include "tests/support/temporary_folder.hpp"

namespace earshot {
namespace {

using namespace std::chrono_literals;
namespace fs = std::filesystem;

/// The script in a tree of its own, whose setup and cmake do nothing and whose earshot-fly prints its arguments, one to a line.
class FlyScript : public testing::Test {
 protected:
  void SetUp() override {
    for (const char* folder : {"sim", "toolchains", "build/release/bin", "bin"}) fs::create_directories(root_ / folder);
    fs::copy_file(fs::path(EARSHOT_SOURCE_DIR) / "sim/fly", root_ / "sim/fly");
    write_program("toolchains/setup", "");
    write_program("toolchains/build", "");
    write_program("bin/cmake", "");
    write_program("build/release/bin/earshot-fly", "printf '%s\\n' \"$@\"");
  }

  [[nodiscard]] std::string arguments_of(const std::string& command_line) const {
    const std::string command = "PATH=" + (root_ / "bin").string() + ":$PATH " + (root_ / "sim/fly").string() + " " + command_line;
    support::Process script("/bin/bash", {"-c", command}, root_ / "text");
    EXPECT_EQ(script.wait(30s), 0) << script.output();
    return script.output();
  }

 private:
  void write_program(const char* name, const char* body) const {
    std::ofstream(root_ / name) << "#!/usr/bin/env bash\n" << body << "\n";
    fs::permissions(root_ / name, fs::perms::owner_all);
  }

 protected:
  const support::TemporaryFolder root_;
};

std::size_t count(const std::string& text, const std::string& what) {
  std::size_t n = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++n;
  return n;
}

TEST_F(FlyScript, HandsItsArgumentsOnWordForWord) {
  EXPECT_EQ(count(arguments_of("--mission a.toml --environment=b.toml"), "--mission"), 1);
  EXPECT_NE(arguments_of("--out 'the --mission of --environment b'").find("the --mission of --environment b\n"), std::string::npos);
}

TEST(FlyScriptHelp, NamesEveryOptionOfEarshotFlyAndEveryFileThatAFlightLeaves) {
  const support::TemporaryFolder folder;
  support::Process program(fs::path(EARSHOT_BIN_DIR) / "earshot-fly", {"--help"}, folder / "program");
  ASSERT_EQ(program.wait(10s), 0);
  support::Process script(fs::path(EARSHOT_SOURCE_DIR) / "sim/fly", {"--help"}, folder / "script");
  ASSERT_EQ(script.wait(10s), 0);
  const std::string options = program.output();
  const std::string help = script.output();
  const std::regex name("\n  (?:-h,)?(--[a-z-]+)");
  for (std::sregex_iterator option(options.begin(), options.end(), name); option != std::sregex_iterator(); ++option)
    EXPECT_NE(help.find((*option)[1].str()), std::string::npos) << (*option)[1];
  const std::regex file(R"(\w+\.(lcmlog|policy|tables|csv|json|html))");
  std::size_t files = 0;
  for (std::sregex_iterator left(options.begin(), options.end(), file); left != std::sregex_iterator(); ++left, ++files)
    EXPECT_NE(help.find(left->str()), std::string::npos) << left->str();
  EXPECT_EQ(files, 10U) << "report.html at --no-report, too";
}

}  // namespace
}  // namespace earshot
