#include "firmware/host/definitions/lcm_text.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace earshot::definitions {
namespace {

std::string text_of(const std::filesystem::path& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

const std::filesystem::path kFolder = std::filesystem::path(EARSHOT_SOURCE_DIR) / "firmware/wire/lcm";

TEST(LcmText, IsWhatStandsInTheFilesThatLcmGenReads) {
  for (const LcmDefinition& definition : lcm_definitions())
    EXPECT_EQ(definition.text, text_of(kFolder / (std::string(definition.type) + ".lcm"))) << definition.type;
}

TEST(LcmText, HasAFileForEveryMessageAndNoOther) {
  const auto files = std::filesystem::directory_iterator(kFolder);
  const auto count = std::count_if(begin(files), end(files), [](const auto& file) { return file.path().extension() == ".lcm"; });
  EXPECT_EQ(static_cast<std::size_t>(count), lcm_definitions().size());
}

TEST(LcmText, NamesTheValuesOfAnEnumAsLcmGensUsersKnowThem) {
  const auto all = lcm_definitions();
  const auto text = [&all](std::string_view type) { return std::ranges::find(all, type, &LcmDefinition::type)->text; };
  EXPECT_NE(text("operator_command_t").find("\n  const int8_t TIGHTEN = 7;\n"), std::string::npos);
  EXPECT_NE(text("command_acknowledgement_t").find("\n  const int8_t OBEYED_NOT_DURABLE = 13;"), std::string::npos);
  EXPECT_NE(text("health_t").find("\n  const int8_t ABORT = 3;\n"), std::string::npos);
  EXPECT_NE(text("health_t").find("\n  const int8_t AUTHORITY_ABORT = 4;\n"), std::string::npos) << "its state has an ABORT, too";
  EXPECT_NE(text("health_t").find("\n  const int8_t END_REASON_FOUND = 10;"), std::string::npos);
}

}  // namespace
}  // namespace earshot::definitions
