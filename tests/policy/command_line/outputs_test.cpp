#include "policy/command_line/outputs.hpp"

#include <gtest/gtest.h>

#include "firmware/host/file/bad_input.hpp"

namespace earshot::command_line {
namespace {

std::string refusal(const std::string& picture) {
  try {
    check_picture_name("-o", picture);
  } catch (const host::BadInput& bad) {
    return bad.what();
  }
  return "not refused";
}

TEST(Outputs, ThatArePicturesEndInPngOrSvg) {
  EXPECT_EQ(refusal("map.pdf"), "-o map.pdf: must end in .png or .svg");
  for (const char* name : {"map.png", "a.b/map.svg"}) EXPECT_EQ(refusal(name), "not refused") << name;
}

}  // namespace
}  // namespace earshot::command_line
