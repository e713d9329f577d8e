// `earshot`, as somebody meets it who does not know its verbs yet.
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/support/process.hpp"
#include "tests/support/temporary_folder.hpp"

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
  EXPECT_EQ(answer.text, "earshot: there is no verb \"feild\"; did you mean field? (earshot help lists all)\n");
}

/// Where one package alone is installed.
TEST(EarshotVerbs, AVerbOfAnotherPackageIsSaidToBeOne) {
  const support::TemporaryFolder folder;
  const std::filesystem::path alone = folder / "earshot";
  std::filesystem::copy_file(std::filesystem::path(EARSHOT_BIN_DIR) / "earshot", alone);
  support::Process process(alone, {"tables"}, folder / "said");
  EXPECT_EQ(process.wait(10s), 2);
  EXPECT_EQ(process.output(),
            "earshot: there is no verb \"tables\" here: it comes with another of the packages earshot-sil, earshot-tools and earshot-hil "
            "(earshot help lists all)\n");
}

TEST(EarshotVerbs, HelpOfAVerbIsTheVerbsOwn) {
  EXPECT_EQ(answer_to({"help", "field"}).text, answer_to({"--help"}, "earshot-field").text);
  EXPECT_EQ(answer_to({"help", "feild"}).status, 2);
}

TEST(EarshotVerbs, HelpSaysOfEachVerbWhatItDoes) {
  const Answer answer = answer_to({"help"});
  EXPECT_EQ(answer.status, 0);
  EXPECT_NE(answer.text.find("  field       computes how loud a source is"), std::string::npos) << answer.text;
}

TEST(EarshotVerbs, TheVersionIsTheSameInEveryProgram) {
  const std::string own = answer_to({"--version"}).text;
  const std::string of_field = answer_to({"--version"}, "earshot-field").text;
  ASSERT_EQ(own.find("earshot 0."), 0U) << own;
  EXPECT_EQ(own.substr(own.find(" 0.")), of_field.substr(of_field.find(" 0.")));
}

}  // namespace
}  // namespace earshot
