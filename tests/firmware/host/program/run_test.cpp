#include "firmware/host/program/run.hpp"

#include <gtest/gtest.h>

#include <array>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iostream>
#include <new>
#include <stdexcept>
#include <string>
#include <system_error>
#include <vector>

#include "firmware/host/file/bad_input.hpp"
#include "firmware/host/file/output_file.hpp"
#include "firmware/host/program/version.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text/tells.hpp"

namespace earshot::program {
namespace {

struct Ran {
  int status = -1;
  std::string output;
  std::string error;
};

Ran ran(const std::function<int()>& work, const std::vector<std::string>& words = {}) {
  CommandLine line("earshot try", "Tries.");
  std::vector<std::string> all{"earshot-try"};
  all.insert(all.end(), words.begin(), words.end());
  std::vector<char*> pointers;
  for (std::string& word : all) pointers.push_back(word.data());
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  Ran result;
  result.status = run(line, static_cast<int>(pointers.size()), pointers.data(), work);
  std::cout.flush();
  result.output = testing::internal::GetCapturedStdout();
  result.error = testing::internal::GetCapturedStderr();
  set_talk(Talk::kNormal);
  return result;
}

TEST(Run, GivesTheStatusOfTheWork) {
  const Ran done = ran([] {
    std::cout << "flown\n";
    return kDone;
  });
  EXPECT_EQ(done.status, kDone);
  EXPECT_EQ(done.output, "flown\n");
  EXPECT_EQ(done.error, "");
  EXPECT_EQ(ran([] { return kIncomplete; }).status, kIncomplete);
}

TEST(Run, LeavesNothingOfAFileThatALibraryWritesWhenASignalEndsTheProgram) {
  const support::TemporaryFolder folder;
  const auto end_while_writing = [&folder] {
    CommandLine line("earshot try", "Tries.");
    std::string word = "earshot-try";
    std::array<char*, 1> words{word.data()};
    (void)run(line, 1, words.data(), [&folder]() -> int {
      host::OutputFile file(folder / "f.nc");
      std::ofstream(file.partial()) << "half";
      return std::raise(SIGTERM);
    });
  };
  EXPECT_EXIT(end_while_writing(), testing::KilledBySignal(SIGTERM), "");
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(Run, SaysOfAPathThatIsEmptyThatItIs) {
  const Ran refused = ran([]() -> int { throw std::filesystem::filesystem_error("", std::make_error_code(std::errc::invalid_argument)); });
  EXPECT_EQ(refused.status, kBadInput);
  EXPECT_TRUE(support::lines_tell(refused.error, {{"without", "name", "cannot", "written"}}));
}

TEST(Run, AnswersAQuestionAndDoesNoWork) {
  bool has_worked = false;
  const Ran asked = ran(
      [&] {
        has_worked = true;
        return kLost;
      },
      {"--version"});
  EXPECT_EQ(asked.status, kDone);
  EXPECT_EQ(asked.output, version_line("earshot try") + "\n");
  EXPECT_FALSE(has_worked);
}

TEST(Run, RefusesACommandLineThatItCannotReadAndDoesNoWork) {
  bool has_worked = false;
  const Ran refused = ran(
      [&] {
        has_worked = true;
        return kDone;
      },
      {"--dephts"});
  EXPECT_EQ(refused.status, kBadInput);
  EXPECT_NE(refused.error.find("--dephts"), std::string::npos) << refused.error;
  EXPECT_FALSE(has_worked);
}

TEST(Run, SaysVersionSettingsAndTimeWhenAskedForMore) {
  const Ran verbose = ran([] { return kDone; }, {"--verbose"});
  EXPECT_EQ(verbose.error.rfind(version_line("earshot try") + "\n", 0), 0U) << verbose.error;
  EXPECT_NE(verbose.error.find("earshot try: took "), std::string::npos) << verbose.error;
}

TEST(Run, TurnsWhatIsThrownIntoOneMessageWithoutControlCharacters) {
  EXPECT_EQ(ran([]() -> int { throw host::BadInput("mission.toml: depth_m is \033[2J"); }).error, "mission.toml: depth_m is \\x1b[2J\n");
  EXPECT_EQ(ran([]() -> int { throw std::runtime_error("no such bus"); }).error, "earshot try: no such bus\n");
  EXPECT_TRUE(support::lines_tell(ran([]() -> int { throw std::bad_alloc(); }).error, {{"earshot", "try", "not enough"}}));
  const Ran unreadable = ran(
      []() -> int { throw std::filesystem::filesystem_error("status", "/sea/floor", std::make_error_code(std::errc::permission_denied)); });
  EXPECT_TRUE(support::lines_tell(unreadable.error, {{"floor", "cannot", "written"}}));
  EXPECT_EQ(unreadable.status, kBadInput);
}

TEST(Run, SaysWhenWhatItPrintedIsLost) {
  const Ran lost = ran([] {
    std::cout.setstate(std::ios::badbit);
    return kDone;
  });
  std::cout.clear();
  EXPECT_EQ(lost.status, kLost);
  EXPECT_TRUE(support::lines_tell(lost.error, {{"earshot", "try", "standard", "cannot"}}));
}

}  // namespace
}  // namespace earshot::program
