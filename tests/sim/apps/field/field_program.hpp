#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "tests/support/temporary_folder.hpp"

namespace earshot::tests {

inline const std::string kMunk = std::string(EARSHOT_SOURCE_DIR) + "/sim/ocean/environments/munk_flat.toml";

inline std::string read(const std::filesystem::path& path) {
  std::ifstream stream(path);
  return {std::istreambuf_iterator<char>(stream), {}};
}

class FieldProgram : public testing::Test {
 protected:
  FieldProgram() { std::filesystem::create_directories(folder_ / "out"); }

  /// @param launcher  stands before the program
  int run(const std::string& arguments, const std::string& launcher = "") {
    const std::string command = launcher + " " + std::string(EARSHOT_BIN_DIR) + "/earshot-field " + arguments + " >" +
                                (folder_ / "stdout").string() + " 2>" + (folder_ / "stderr").string();
    const int status = std::system(command.c_str());  // NOLINT(concurrency-mt-unsafe): one thread
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  [[nodiscard]] std::string said() const { return read(folder_ / "stdout"); }
  [[nodiscard]] std::string errors() const { return read(folder_ / "stderr"); }
  [[nodiscard]] bool nothing_written() const { return std::filesystem::is_empty(folder_ / "out"); }
  [[nodiscard]] std::string output() const { return (folder_ / "out" / "field.nc").string(); }

  /// The shipped ocean with one part of its file changed.
  std::string ocean_with(const std::string& what, const std::string& by) {
    std::string text = read(kMunk);
    text.replace(text.find(what), what.size(), by);
    const auto path = folder_ / "ocean.toml";
    std::ofstream(path) << text;
    return path.string();
  }
  /// Of the ocean that ships, out to 2 km.
  void expect_drawn(const std::string& arguments, const std::vector<std::string>& words) {
    const std::string picture = (folder_ / "out" / "field.svg").string();
    ASSERT_EQ(run(kMunk + " -o " + output() + " --max-range-km 2 " + arguments + " --plot " + picture), 0) << errors();
    const std::string svg = read(picture);
    for (const std::string& word : words) EXPECT_NE(svg.find(word), std::string::npos) << word;
  }
  void expect_refused(const std::string& arguments, const std::string& mentioned) {
    EXPECT_EQ(run(arguments), 2);
    EXPECT_NE(errors().find(mentioned), std::string::npos) << errors();
    EXPECT_TRUE(nothing_written());
  }

  const support::TemporaryFolder folder_;
};

}  // namespace earshot::tests
