#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "firmware/host/mission/mission_file.hpp"
#include "firmware/host/toml/table_reader.hpp"
#include "tests/support/temporary_folder.hpp"

namespace earshot::host {

inline const std::filesystem::path kShipped =
    std::filesystem::path(EARSHOT_SOURCE_DIR) / "firmware/boards/linux/missions/fixed_source.toml";

inline std::string text_of(const std::filesystem::path& path) {
  std::ifstream stream(path);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// What load_mission says about the shipped mission with one piece of text replaced; paths become "FILE".
inline std::string complaint(const std::string& from, const std::string& to) {
  std::string text = text_of(kShipped);
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  text.replace(at, from.size(), to);
  const support::TemporaryFolder folder;
  const std::filesystem::path path = folder / "mission.toml";
  std::ofstream(path) << text;
  std::string what;
  try {
    (void)load_mission(path);
  } catch (const host::BadInput& e) {
    what = e.what();
  }
  for (std::size_t p = what.find(path.string()); p != std::string::npos; p = what.find(path.string()))
    what.replace(p, path.string().size(), "FILE");
  return what;
}

}  // namespace earshot::host
