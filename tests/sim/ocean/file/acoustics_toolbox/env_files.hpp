#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "firmware/host/file/bad_input.hpp"
#include "sim/ocean/file/acoustics_toolbox/env_file.hpp"
#include "tests/support/temporary_folder.hpp"

namespace earshot::tests {

/// A file of BELLHOP's, a line each, with every part that Earshot reads.
inline const std::string kBellhop =
    "'A case'\n"
    "200.0 ! Hz\n"
    "1\n"
    "'CVW'\n"
    "51 0.0 100.0\n"
    "0.0 1500.0 /\n"
    "40 1490 0 1 0 /\n"
    "100.0 1495.0 /\n"
    "'A' 0.0\n"
    "100.0 1650.0 0.0 1.7 0.6 /\n"
    "1\n"
    "30.0 /\n"
    "5\n"
    "0 80 /\n"
    "3\n"
    "0.5 1.0 1.5\n"
    "'C'\n"
    "0\n";

/// The files of a case in a folder that nobody else has.
class EnvFiles : public testing::Test {
 protected:
  [[nodiscard]] static std::string with(std::string text, const std::string& what, const std::string& by) {
    EXPECT_NE(text.find(what), std::string::npos) << what;
    return text.replace(text.find(what), what.size(), by);
  }
  std::filesystem::path write(const std::string& name, const std::string& text) {
    std::ofstream(folder_ / name) << text;
    return folder_ / name;
  }
  [[nodiscard]] ocean::RadialCase load(const std::string& text) { return ocean::acoustics_toolbox::load_env(write("a.env", text)); }
  void expect_complaint(const std::string& text, const std::string& part) {
    try {
      (void)load(text);
      ADD_FAILURE() << "was read, in place of: " << part;
    } catch (const host::BadInput& bad) {
      EXPECT_NE(std::string(bad.what()).find(part), std::string::npos) << bad.what();
    }
  }

  const support::TemporaryFolder folder_;
};

}  // namespace earshot::tests
