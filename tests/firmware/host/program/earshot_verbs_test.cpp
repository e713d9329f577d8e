// `earshot`, as somebody meets it who does not know its verbs yet.
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/process.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot {
namespace {

using namespace std::chrono_literals;

struct Answer {
  int status;
  std::string text;
};

Answer answer_to(const std::vector<std::string>& words, const std::string& program = "earshot") {
  const support::TemporaryFolder folder;
  support::Process process(std::filesystem::path(EARSHOT_BIN_DIR) / program, words, folder / "said");
  const int status = process.wait(10s);
  return {status, process.output()};
}

TEST(EarshotVerbs, ASlipIsAnsweredWithTheVerbThatWasMeant) {
  const Answer answer = answer_to({"feild"});
  EXPECT_EQ(answer.status, 2);
  EXPECT_TRUE(support::lines_tell(answer.text, {{"earshot", "no", "feild", "mean field"}}));
}

/// Where one package alone is installed.
TEST(EarshotVerbs, AVerbOfAnotherPackageIsSaidToComeWithThatOne) {
  const support::TemporaryFolder folder;
  const std::filesystem::path alone = folder / "earshot";
  std::filesystem::copy_file(std::filesystem::path(EARSHOT_BIN_DIR) / "earshot", alone);
  // "sil earshot-fly": as the build shares the programs out to packages.
  std::ifstream programs(std::filesystem::path(EARSHOT_BIN_DIR).parent_path() / "programs.txt");
  std::string component;
  std::string program;
  int judged = 0;
  while (programs >> component >> program) {
    if (!program.starts_with("earshot-") || component == "runtime") continue;
    const std::string verb = program.substr(8);
    support::Process process(alone, {verb}, folder / "said");
    EXPECT_EQ(process.wait(10s), 2);
    const std::string package = "earshot-" + component;
    EXPECT_EQ(process.output(), "earshot: there is no verb \"" + verb + "\" here: the package " + package + " brings it (apt install ./" +
                                    package + "_*.deb) (earshot help lists all)\n");
    ++judged;
  }
  EXPECT_GE(judged, 15);
}

TEST(EarshotVerbs, InASourceTreeAScriptsVerbIsAnsweredWithWhereTheScriptStands) {
  const std::string tree = EARSHOT_SOURCE_DIR;
  if (std::filesystem::path(EARSHOT_BIN_DIR).parent_path().parent_path().parent_path() != tree) GTEST_SKIP() << "built elsewhere";
  for (const auto& [verb, script] : {std::pair{"hil", "/hil/run"}, std::pair{"with-can", "/hil/bus/with-can"}}) {
    const Answer answer = answer_to({verb, "--help"});
    EXPECT_EQ(answer.status, 2);
    EXPECT_EQ(answer.text, std::string("earshot: in a source tree ") + verb + " is " + tree + script + "\n");
    EXPECT_TRUE(std::filesystem::exists(tree + script));
  }
  const std::string help = answer_to({"help"}).text;
  EXPECT_TRUE(support::has_line(help, {"hil/run", "hil/bus/with-can"})) << help;
}

TEST(EarshotVerbs, HelpOfAVerbIsTheVerbsOwn) {
  EXPECT_EQ(answer_to({"help", "field"}).text, answer_to({"--help"}, "earshot-field").text);
  EXPECT_EQ(answer_to({"help", "feild"}).status, 2);
}

TEST(EarshotVerbs, HelpSaysOfEachVerbWhatItDoes) {
  const Answer answer = answer_to({"help"});
  EXPECT_EQ(answer.status, 0);
  EXPECT_TRUE(support::has_line(answer.text, {"field", "computes", "source"})) << answer.text;
}

/// programs.txt: COMPONENT PROGRAM, a line each, as they are packed.
TEST(EarshotVerbs, HelpNamesThePackageThatBringsEachVerb) {
  std::ifstream packed(std::filesystem::path(EARSHOT_BIN_DIR).parent_path() / "programs.txt");
  const std::string help = answer_to({"help"}).text;
  int count = 0;
  for (std::string component, program; packed >> component >> program;) {
    if (!program.starts_with("earshot-")) continue;
    ++count;
    const std::size_t place = help.find("\n  " + program.substr(8) + " ");
    ASSERT_NE(place, std::string::npos) << program;
    const std::size_t heading = help.rfind("\nPackage ", place);
    ASSERT_NE(heading, std::string::npos) << program;
    const std::string package = component == "runtime" ? "earshot" : "earshot-" + component;
    EXPECT_EQ(help.substr(heading, help.find('\n', heading + 1) - heading), "\nPackage " + package + ":") << program;
  }
  EXPECT_GE(count, 20);
}

TEST(EarshotVerbs, HelpEndsWithThePageToBeginWithWhereverItRuns) {
  const support::TemporaryFolder folder;
  std::filesystem::create_directories(folder / "usr/bin");
  std::filesystem::create_directories(folder / "usr/share/doc/earshot");
  const std::filesystem::path page = folder / "usr/share/doc/earshot/README.Debian";
  std::ofstream(page) << "begin";
  std::filesystem::copy_file(std::filesystem::path(EARSHOT_BIN_DIR) / "earshot", folder / "usr/bin/earshot");
  support::Process installed(folder / "usr/bin/earshot", {"help"}, folder / "said");
  EXPECT_EQ(installed.wait(10s), 0);
  EXPECT_TRUE(installed.output().ends_with("\nWhere to begin: " + page.string() + "\n")) << installed.output();
  EXPECT_TRUE(answer_to({"help"}).text.ends_with("/README.md\n"));
}

TEST(EarshotVerbs, TheVersionIsTheSameInEveryProgram) {
  const std::string own = answer_to({"--version"}).text;
  const std::string of_field = answer_to({"--version"}, "earshot-field").text;
  ASSERT_EQ(own.find("earshot 0."), 0U) << own;
  EXPECT_EQ(own.substr(own.find(" 0.")), of_field.substr(of_field.find(" 0.")));
}

}  // namespace
}  // namespace earshot
