#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/process.hpp"
#include "tests/support/temporary_folder.hpp"

namespace earshot::policy_programs {

namespace fs = std::filesystem;

inline const std::string kSource = EARSHOT_SOURCE_DIR;
inline const std::string kOcean = " --environment " + kSource + "/sim/ocean/environments/munk_flat.toml";
inline const std::string kFixedSource = kSource + "/policy/frozen/fixed_source.policy";

inline std::string content(const fs::path& path) {
  return support::read_text(path);
}

/// The paper's environment over a sea floor of two stations, in a file that it names; makes both.
inline void write_ocean_with_section(const fs::path& environment, const fs::path& section) {
  std::ofstream(section) << "range_m,depth_m\n0,3000\n100000,3000\n";
  const std::string flat = "[seabed]\ndepth_m = 3000.0";
  std::string text = content(kSource + "/sim/ocean/environments/munk_flat.toml");
  const std::string own = "[bathymetry]\nlayout = \"section_csv\"\nfile = \"" + section.filename().string() + "\"\n[seabed]";
  std::ofstream(environment) << text.replace(text.find(flat), flat.size(), own);
}

/// A folder of its own, in which a test runs the commands.
class Programs : public testing::Test {
 protected:
  /// Starts a program in the test's folder; its standard output and error go to the files `out` and `err` there.
  support::Process start(const fs::path& program, const std::vector<std::string>& arguments) {
    return support::Process(program, arguments, {.folder = folder, .output = folder / "out", .errors = folder / "err"});
  }

  /// Starts `earshot-<words>`; the words are separated by spaces.
  support::Process start(const std::string& words) {
    const std::vector<std::string> all = split(words);
    return start(EARSHOT_BIN_DIR "/earshot-" + all.front(), {all.begin() + 1, all.end()});
  }

  /// Runs `earshot-<words>`, under a launcher such as mpiexec where there is one. @return its exit status
  int run(const std::string& words, const std::string& launcher = "") {
    if (launcher.empty()) return start(words).wait(kPatience);
    const std::vector<std::string> all = split(launcher + " " EARSHOT_BIN_DIR "/earshot-" + words);
    return start(all.front(), {all.begin() + 1, all.end()}).wait(kPatience);
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

  static std::vector<std::string> split(const std::string& words) {
    std::istringstream stream(words);
    return {std::istream_iterator<std::string>(stream), {}};
  }

  static constexpr std::chrono::minutes kPatience{10};  // no test takes it: a program that hangs ends the test
  const support::TemporaryFolder folder;
};

}  // namespace earshot::policy_programs
