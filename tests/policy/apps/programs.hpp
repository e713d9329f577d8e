#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <iterator>
#include <string>
#include <vector>

namespace earshot::apps {

namespace fs = std::filesystem;

inline const std::string kSource = EARSHOT_SOURCE_DIR;
inline const std::string kOcean = " --environment " + kSource + "/sim/ocean/environments/munk_flat.toml";
inline const std::string kFixedSource = kSource + "/policy/frozen/fixed_source.policy";

inline std::string content(const fs::path& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

/// A folder of its own, in which a test runs the commands.
class Programs : public testing::Test {
 protected:
  Programs() {
    folder = fs::path(testing::TempDir()) / ("programs_" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
    fs::remove_all(folder);
    fs::create_directories(folder);
  }
  ~Programs() override { fs::remove_all(folder); }

  /// Runs `earshot-<words>` in the test's folder; returns its exit status.
  int run(const std::string& words, const std::string& launcher = "") {
    const std::string command = "cd '" + folder.string() + "' && " + launcher + "'" EARSHOT_BIN_DIR "/earshot-" +
                                words.substr(0, words.find(' ')) + "'" + words.substr(words.find(' ')) + " >out 2>err";
    const int status = std::system(command.c_str());  // NOLINT: our own programs
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  /// Exit status 2, one line on standard error that holds every one of `parts`, and nothing left in the folder.
  void refuses(const std::string& words, std::initializer_list<std::string> parts) {
    const auto files_before = files();
    EXPECT_EQ(run(words), 2) << words;
    const std::string said = content(folder / "err");
    EXPECT_EQ(std::ranges::count(said, '\n'), 1) << said;
    for (const std::string& part : parts) EXPECT_NE(said.find(part), std::string::npos) << part << " is not in: " << said;
    EXPECT_EQ(files(), files_before) << "left something behind: " << words;
  }

  std::vector<std::string> files() const {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder)) {
      const std::string name = entry.path().filename().string();
      if (name != "out" && name != "err") names.push_back(name);
    }
    std::ranges::sort(names);
    return names;
  }

  fs::path folder;
};

}  // namespace earshot::apps
